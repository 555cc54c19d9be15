// The clock and the signals of a run: when to stop although the physics is not done.
//
// SIGTERM, SIGINT, SIGUSR1 and SIGUSR2 ask for the end after the step under way, with a
// checkpoint; the second SIGTERM or SIGINT ends at once. (Open MPI's mpirun kills soon after it
// has passed on SIGTERM; it passes on SIGUSR1 and SIGUSR2 without that. Batch systems send either
// ahead of their limit.) A signal that reaches one rank stops all: the step's reduction carries
// it, as it carries the clock, so that all ranks decide alike.
#pragma once
#include <chrono>
#include <string>

#include "framework/base/reduction.hpp"

namespace sluice {

class RunControl {
 public:
  // Installs the handlers and starts the clock. One at a time in a process: std::logic_error for a
  // second one.
  RunControl();
  // Puts the former handlers back.
  ~RunControl();
  RunControl(const RunControl&) = delete;
  RunControl& operator=(const RunControl&) = delete;

  // Seconds since the construction, on this rank.
  double wall_seconds() const;

  // What all ranks must agree upon, in the reduction that a step does anyway.
  struct Question {
    Reduction::Maximum wall;
    Reduction::Maximum signal;
  };
  struct Answer {
    double wall_seconds = 0;  // the slowest clock of all ranks
    int signal = 0;           // the signal that asks for the end; 0: none
    bool terminate() const { return signal != 0; }
  };
  Question ask(Reduction& reduction) const;
  Answer read(const Reduction& reduction, const Question& question) const;

  // "SIGTERM"
  static std::string signal_name(int signal);

 private:
  std::chrono::steady_clock::time_point start_;
};

}  // namespace sluice
