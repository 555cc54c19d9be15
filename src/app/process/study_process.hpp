// Running another program and waiting for it, its output kept in files.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace sluice {

struct ProcessRequest {
  std::vector<std::string> words;        // program (a path) and arguments
  std::vector<std::string> environment;  // NAME=VALUE, beside what this program has itself
  std::filesystem::path output;          // of stdout and stderr together; empty: this program's
};

// The exit status, or 128 + signal. SystemError when it cannot be started.
int run_process(const ProcessRequest& request);

// The path of this very executable; SystemError where the system does not tell it.
std::filesystem::path own_executable();

// The last lines of a text file, for messages.
std::string last_lines(const std::filesystem::path& file, int count);

}  // namespace sluice
