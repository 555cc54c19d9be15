// Runs a compiled sweep over one block: every task, plane by plane, in scratch memory.
//
// The planes of the last active axis are visited once; at plane k a task with lead L computes plane
// k + L of what it writes, into rings of planes. Nothing that is temporary leaves the cache, and
// nothing is exchanged inside the sweep: what neighbours would send is recomputed.
//
// Blocks that follow each other along the swept axis, of one box or of several, may be swept as one
// stack: planes near where they meet are then computed once for both. Only tasks that neither store
// nor reduce anything are shared; what they leave in a cell is the same for every block that needs
// it, so that stacks change no result.
#pragma once
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "framework/field/warehouse.hpp"
#include "framework/task/graph.hpp"
#include "framework/task/reductions.hpp"
#include "framework/task/row_arrays.hpp"

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

// A block: cells of local box number `box`.
struct SweepPiece {
  int box = 0;
  IndexBox cells;
};

// The working state of one thread.
class BlockSweep {
 public:
  // `largest_block`: extents that no block, and across the swept axis no stack, exceeds; scratch
  // memory is sized for it once. Sweeps that never run at the same time may share it.
  BlockSweep(const TaskList& list, const SweepPlan& plan, const Level& level,
             const StateBinding& binding, IntVec3 largest_block,
             std::shared_ptr<AlignedArray> scratch = std::make_shared<AlignedArray>());

  // Computes one block (a part of local box number `box`); reductions are added to `reductions`.
  // With `times`, each task's time is added to it.
  void run(const StepConstants& step, int box, const IndexBox& block, Reductions& reductions,
           TaskTimes* times = nullptr);

  // A stack: each piece begins where the one before ends along the swept axis (the last active one
  // of two or three), and shares some of its cells across.
  void run(const StepConstants& step, std::span<const SweepPiece> stack, Reductions& reductions,
           TaskTimes* times = nullptr);

  // Of all that share it.
  std::size_t scratch_bytes() const { return scratch_->size() * sizeof(double); }

 private:
  // How a task runs where pieces of a stack want the same plane of it.
  enum class Sharing {
    none,    // for each piece
    plane,   // once
    states,  // likewise, if all pieces have the same arrays; else as parts
    parts,   // of each piece what those before lack
  };

  // Cells in the order row, middle, swept; directions that are not active are left out.
  struct Window {
    int low[3] = {0, 0, 0};
    int high[3] = {1, 1, 1};
  };

  // A planned task as it is bound.
  struct BoundTask {
    const RowKernel* kernel;
    ReductionOffsets places;
    Sharing sharing;
    bool stores;     // or reduces
    int reads;       // accesses before the writes
    RowArrays rows;  // of its accesses
    std::vector<std::pair<std::size_t, std::size_t>> buffers{}, states{};  // access, in arrays_
    std::size_t chosen = 0;       // the piece whose states are bound
    std::size_t first_piece = 0;  // pieces below are done
  };

  BoundTask bind_task(const PlannedTask& planned, const std::vector<std::size_t>& number) const;
  Sharing sharing_of(const PlannedTask& planned) const;
  static Window window_of(const IndexBox& block, const Growth& growth, const Axes& axes);
  static Window bounding(const Window& a, const Window& b);
  Window window_in(const PlannedTask& planned, const SweepPiece& piece) const;
  static std::ptrdiff_t buffer_size(const PlannedBuffer& buffer, IntVec3 block, const Axes& axes,
                                    int components);
  void find_windows();
  void bind_states(std::size_t piece, int box);
  bool has_arrays_of_the_one_before(std::size_t piece) const;
  void bind_scratch(const IndexBox& hull);
  void choose(std::size_t task, std::size_t piece, Row& row);
  void run_task(std::size_t task, int plane, Row& row);
  void run_parts(std::size_t task, std::size_t first, std::size_t last, int plane, Row& row);
  // `alone`: nothing else of the task's is on this plane.
  void run_plane(std::size_t task, const Window& window, int plane, Row& row, bool alone = false);
  const Window& window(std::size_t task, std::size_t piece) const {
    return windows_[task * stack_.size() + piece];
  }

  const TaskList* list_;
  const SweepPlan* plan_;
  const Level* level_;
  const StateBinding* binding_;
  std::shared_ptr<AlignedArray> scratch_;
  // Temporaries in the order of their buffers, then the state variables of each piece.
  std::vector<BoundArray> arrays_;
  std::vector<Steps> buffer_steps_;           // of temporaries
  IndexBox hull_{};                           // that they are bound for
  const double* scratch_data_ = nullptr;      // likewise
  std::vector<std::size_t> state_variables_;  // those that are no temporaries
  std::vector<BoundTask> tasks_;              // as planned
  // Of the stack at hand.
  std::span<const SweepPiece> stack_;
  std::vector<Steps> state_steps_;       // by piece and state variable, two of each
  std::vector<int> array_set_of_piece_;  // by piece: those of one number have the same arrays
  std::vector<Window> windows_;          // by planned task and piece
};

}  // namespace sluice
