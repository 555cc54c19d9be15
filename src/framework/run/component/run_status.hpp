// How a run ended, in the words that scripts read.
#pragma once

namespace sluice {

enum class RunStatus { running, done, max_steps, wall_limit, terminated, failed };

inline const char* to_string(RunStatus status) {
  switch (status) {
    case RunStatus::running:
      return "running";
    case RunStatus::done:
      return "done";
    case RunStatus::max_steps:
      return "max_steps";
    case RunStatus::wall_limit:
      return "wall_limit";
    case RunStatus::terminated:
      return "terminated";
    case RunStatus::failed:
      return "failed";
  }
  return "failed";
}

}  // namespace sluice
