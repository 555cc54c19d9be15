// How a level is swept.
#pragma once
#include <cstdint>
#include <memory>

#include "framework/base/vec3.hpp"
#include "framework/task/thread_team.hpp"

namespace sluice {

struct SolverOptions {
  int threads = 1;
  bool force_all = false;          // no block sleeps, nothing of a step is left out
  int sample_every = 0;            // time every n-th block; 0: never
  IntVec3 block{};                 // extents of a block; 0: chosen
  std::int64_t max_box_cells = 0;  // of boxes of adaptive levels; 0: no limit
  int substeps = 1;                // of this level in one coarse step
  std::shared_ptr<const ThreadTeam> team = nullptr;  // of `threads`; none: an own one
  bool joined = false;  // one of several levels: fluxes are recorded, sums count uncovered cells
};

}  // namespace sluice
