// What `sluice run` adds at its end: the error against the deck's exact solution, a picture, how to
// go on, and its exit status.
#pragma once
#include <filesystem>
#include <string>

#include "framework/run/component/run_status.hpp"

namespace sluice {

// A line for each saved variable that the exact solution has; empty when the deck names none.
std::string error_lines(const std::filesystem::path& archive);

// Draws the last output into the archive's folder; the picture's path.
// SystemError when it cannot be drawn.
std::filesystem::path draw_picture(const std::filesystem::path& archive);

// By a signal or a time limit, not by what the deck or the caller's --max-steps asked for.
bool ended_early(RunStatus status);
int exit_status_of(RunStatus status);

// How a shell finds this program from any folder: "sluice", where that leads to it, or its path.
std::string program_word();

// What the command that goes on has to name.
struct ContinueWords {
  std::filesystem::path archive, parent;
  int ranks = 1, threads = 1;
  bool force_directions = false;
  std::string program = "sluice";
};
// For a shell, from any folder.
std::string command_to_continue(const ContinueWords& words);

}  // namespace sluice
