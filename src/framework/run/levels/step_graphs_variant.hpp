// A compiled graph of a level's step or diagnostics; for the files of StepGraphs alone.
#pragma once
#include "framework/run/levels/step_graphs.hpp"

namespace sluice {

struct StepGraphs::Variant {
  std::vector<std::unique_ptr<TaskList>> lists;  // by kind, those that were met
  std::unique_ptr<SweepExecutor> executor;
  int layout = -1;  // of the level when it was last bound
  int boxes = -1;   // likewise, without what joints change
};

}  // namespace sluice
