// Runs a sweep over all local boxes of a level: placement on blocks and threads.
//
// Blocks are windows of boxes sized for the cache. Their number and shape change nothing in the
// results. Each runs the graph of its kind, found anew from the old state in every sweep; blocks of
// one kind that follow each other are swept as one stack. A block
// whose old state is uniform over itself and the whole stencil sleeps: its state is copied, and
// only the cells that touch the boundary of the domain (they account for what passes through it)
// and one cell besides (it gives its time-step rate) are computed.
#pragma once
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "framework/task/block_sweep.hpp"
#include "framework/task/sweep_blocks.hpp"
#include "framework/task/sweep_kinds.hpp"
#include "framework/task/thread_team.hpp"

namespace sluice {

struct SweepOptions {
  int threads = 1;
  std::shared_ptr<const ThreadTeam> team;  // of that many threads; none: an own one
  IntVec3 block{};  // extents of a block; 0: the default of the level at this size
  BlockSize size = BlockSize::large;
  bool skip_uniform_blocks = false;  // may uniform blocks sleep
  int maxima = 0, sums = 0;          // of the reductions
  int sample_every = 0;              // time every n-th block per task; 0: never
  bool time_boxes = false;           // measure what each box costs
  // Blocks (local box number, cells) that must not sleep; asked when bound.
  std::function<bool(int, const IndexBox&)> never_skipped;
};

class SweepExecutor {
 public:
  SweepExecutor(SweepKinds kinds, const Level& level, const SweepOptions& options);
  // One kind only.
  SweepExecutor(const TaskList& list, SweepPlan plan, const Level& level,
                const SweepOptions& options);
  ~SweepExecutor();

  // Finds slots (the warehouses must have them) and remembers the warehouses. Again when the boxes
  // of the level have changed; what was counted and timed is kept.
  // With `same_boxes` what boxes cost is kept too. A new state that is cut as the sweep is
  // (block_extents) remembers which blocks hold nothing but an absent value.
  void bind(const Warehouse& old_state, Warehouse& new_state, Warehouse* output,
            bool same_boxes = false);
  IntVec3 block_extents(const std::vector<GridBox>& local_boxes) const;
  // Without boxes for a while: memory goes until the next bind, what was counted is kept.
  void rest();
  // One pass over all blocks. The result holds what this rank reduced.
  const Reductions& run(const StepConstants& step);

  int kinds() const { return kinds_.count; }
  bool met(int kind) const { return graphs_[kind] != nullptr; }
  // Of the last kind where none is given; compiled if need be.
  const SweepPlan& plan(int kind = -1);
  const TaskList& list(int kind = -1);

  std::int64_t blocks_run() const { return blocks_run_; }  // since construction
  std::int64_t blocks_run(int kind) const;
  std::int64_t blocks_skipped() const { return skipped_.blocks; }
  std::int64_t cells_skipped() const { return skipped_.cells; }  // that were not updated
  std::size_t scratch_bytes() const;
  // Seconds spent in each local box since the last bind, where boxes are timed.
  std::vector<double> box_seconds() const;
  // Seconds per planned task of a kind that was met, scaled up from the sampled blocks.
  std::vector<double> task_seconds(int kind = 0) const;

 private:
  struct Graph;
  struct SweepCounts;
  struct Worker;
  Graph& meet(int kind);
  void bind(Graph& graph) const;
  void choose_kinds();
  void make_workers(IntVec3 largest);
  void make_sweep(Worker& worker, int kind) const;
  void keep_counts();
  SweepCounts counts_of(int kind) const;
  void place_stacks();
  void run_stack(Worker& worker, const StepConstants& step, std::size_t stack);
  void sweep_pieces(Worker& worker, const StepConstants& step, int kind, bool sample);
  void charge(Worker& worker, std::int64_t nanoseconds, std::span<const SweepPiece> pieces) const;
  void leave_absent(const Graph& graph, std::size_t n);
  bool is_skippable(const Graph& graph, const Block& block) const;
  void skip(Worker& worker, const StepConstants& step, const Block& block);

  SweepKinds kinds_;
  std::vector<std::unique_ptr<Graph>> graphs_;  // by kind, those that were met
  const Level* level_;
  SweepOptions options_;
  std::shared_ptr<const ThreadTeam> team_;
  const Warehouse* old_state_ = nullptr;
  Warehouse* new_state_ = nullptr;
  Warehouse* output_ = nullptr;
  bool remembers_ = false;  // the new state is cut into the same blocks
  std::vector<Block> blocks_;
  std::vector<std::vector<std::size_t>> stacks_;  // of blocks that one thread sweeps in order
  std::vector<std::unique_ptr<Worker>> workers_;
  IntVec3 largest_{};  // block or stack that the workers' memory holds
  Reductions total_;
  // What slept, since construction.
  struct Skipped {
    std::int64_t blocks = 0, cells = 0;
    void add(const Skipped& other) {
      blocks += other.blocks;
      cells += other.cells;
    }
  };
  std::int64_t blocks_run_ = 0, passes_ = 0;
  Skipped skipped_;
  Skipped kept_skipped_;  // counted before the workers were made anew
};

}  // namespace sluice
