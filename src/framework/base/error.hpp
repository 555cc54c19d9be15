// The three ways a command can fail, each with its exit status.
//
//   PhysicsError 1   the comparison or the physics failed (a named cell, material, task, step)
//   InputError   2   bad input: deck, option, archive path; nothing was computed
//   SystemError  3   the machine failed: disk, memory, MPI
//
// A message says what was found, where, what is allowed and what to try next.
#pragma once
#include <stdexcept>
#include <string>

namespace sluice {

enum class ExitStatus { good = 0, failed = 1, bad_input = 2, system = 3 };

class Error : public std::runtime_error {
 public:
  Error(ExitStatus status, const std::string& message)
      : std::runtime_error(message), status_(status) {}
  ExitStatus status() const { return status_; }

 private:
  ExitStatus status_;
};

class PhysicsError : public Error {
 public:
  explicit PhysicsError(const std::string& message) : Error(ExitStatus::failed, message) {}
};

class InputError : public Error {
 public:
  explicit InputError(const std::string& message) : Error(ExitStatus::bad_input, message) {}
};

class SystemError : public Error {
 public:
  explicit SystemError(const std::string& message) : Error(ExitStatus::system, message) {}
};

}  // namespace sluice
