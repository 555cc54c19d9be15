// Runs a compiled sweep over one block: every task, plane by plane, in scratch memory.
//
// The planes of the last active axis are visited once; at plane k a task with lead L computes plane
// k + L of what it writes, into rings of planes. Nothing that is temporary leaves the cache, and
// nothing is exchanged inside the sweep: what neighbours would send is recomputed.
#pragma once
#include <chrono>
#include <memory>
#include <vector>

#include "framework/field/warehouse.hpp"
#include "framework/task/graph.hpp"
#include "framework/task/reductions.hpp"

namespace sluice {

// Where the variables of a sweep live for one box.
struct StateBinding {
  const Warehouse* old_state = nullptr;
  Warehouse* new_state = nullptr;
  Warehouse* output = nullptr;  // may be null when no output is wanted
  std::vector<int> slot;        // by variable: slot in its warehouse, -1 for temporaries
};

// Nanoseconds spent in each planned task, over the blocks that were sampled.
using TaskTimes = std::vector<std::int64_t>;

// The working state of one thread.
class BlockSweep {
 public:
  // `largest_block`: extents that no block exceeds; scratch memory is sized for it once. Sweeps
  // that never run at the same time may share it.
  BlockSweep(const TaskList& list, const SweepPlan& plan, const Level& level,
             const StateBinding& binding, IntVec3 largest_block,
             std::shared_ptr<AlignedArray> scratch = std::make_shared<AlignedArray>());

  // Computes one block (a part of local box number `box`); reductions are added to `reductions`.
  // With `times`, each task's time is added to it.
  void run(const StepConstants& step, int box, const IndexBox& block, Reductions& reductions,
           TaskTimes* times = nullptr);

  // Of all that share it.
  std::size_t scratch_bytes() const { return scratch_->size() * sizeof(double); }

 private:
  void bind_states(int box);
  void bind_scratch(const IndexBox& block);
  void run_plane(std::size_t task, const IndexBox& window, int plane, Row& row);

  const TaskList* list_;
  const SweepPlan* plan_;
  const Level* level_;
  const StateBinding* binding_;
  std::shared_ptr<AlignedArray> scratch_;
  std::vector<BoundArray> bound_;                               // by variable
  std::vector<std::vector<double*>> components_;                // by variable: arrays of states
  std::vector<std::vector<const BoundArray*>> reads_, writes_;  // by planned task
  std::vector<IndexBox> windows_;  // by planned task, of the block at hand
};

}  // namespace sluice
