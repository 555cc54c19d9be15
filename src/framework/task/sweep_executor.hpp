// Runs a sweep over all local boxes of a level: placement on blocks and threads.
//
// Blocks are windows of boxes sized for the cache. Their number and shape change nothing in the
// results. A block whose old state is uniform over itself and the whole stencil sleeps: its state
// is copied, and only the cells that touch the boundary of the domain (they account for what passes
// through it) and one cell besides (it gives its time-step rate) are computed.
#pragma once
#include <functional>
#include <memory>
#include <vector>

#include "framework/task/block_sweep.hpp"
#include "framework/task/thread_team.hpp"

namespace sluice {

struct SweepOptions {
  int threads = 1;
  std::shared_ptr<const ThreadTeam> team;  // of that many threads; none: an own one
  IntVec3 block{};            // extents of a block; 0: chosen from the number of active directions
  bool quiet_blocks = false;  // may uniform blocks sleep
  int maxima = 0, sums = 0;   // of the reductions
  int sample_every = 0;       // time every n-th block per task; 0: never
  bool time_boxes = false;    // measure what each box costs
  // Blocks (local box number, cells) that must not sleep; asked when bound.
  std::function<bool(int, const IndexBox&)> never_sleeps;
};

struct Block {
  int box = 0;  // local box number
  IndexBox cells;
  bool may_sleep = true;
};

// Cuts the local boxes of a level into blocks no larger than `extents`.
std::vector<Block> place_blocks(const std::vector<GridBox>& boxes, IntVec3 extents);
IntVec3 default_block(const Level& level);
IntVec3 even_blocks(IntVec3 extents, const std::vector<GridBox>& boxes, const Axes& axes,
                    int threads);

class SweepExecutor {
 public:
  SweepExecutor(const TaskList& list, SweepPlan plan, const Level& level,
                const SweepOptions& options);
  ~SweepExecutor();

  // Finds slots (the warehouses must have them) and remembers the warehouses. Again when the boxes
  // of the level have changed; what was counted and timed is kept.
  // With `same_boxes` what boxes cost is kept too.
  void bind(const Warehouse& old_state, Warehouse& new_state, Warehouse* output,
            bool same_boxes = false);
  // Without boxes for a while: memory goes until the next bind, what was counted is kept.
  void rest();
  // One pass over all blocks. The result holds what this rank reduced.
  const Reductions& run(const StepConstants& step);

  const SweepPlan& plan() const { return plan_; }
  const TaskList& list() const { return *list_; }
  std::int64_t blocks_run() const { return blocks_run_; }  // since construction
  std::int64_t blocks_asleep() const { return blocks_asleep_; }
  std::size_t scratch_bytes() const;
  // Seconds spent in each local box since the last bind, where boxes are timed.
  std::vector<double> box_seconds() const;
  // Seconds per planned task, scaled up from the sampled blocks.
  std::vector<double> task_seconds() const;

 private:
  struct Worker;
  void make_workers(IntVec3 largest);
  void keep_counts();
  void run_timed_block(Worker& worker, const StepConstants& step, std::size_t n);
  void run_block(Worker& worker, const StepConstants& step, std::size_t n);
  bool is_quiet(const Block& block) const;
  void sleep(Worker& worker, const StepConstants& step, const Block& block);

  const TaskList* list_;
  SweepPlan plan_;
  const Level* level_;
  SweepOptions options_;
  std::shared_ptr<const ThreadTeam> team_;
  StateBinding binding_;
  std::vector<Block> blocks_;
  std::vector<std::unique_ptr<Worker>> workers_;
  IntVec3 largest_{};  // block that the workers' memory holds
  Reductions total_;
  std::int64_t blocks_run_ = 0, blocks_asleep_ = 0, passes_ = 0;
  // Counted and timed before the last bind.
  std::int64_t kept_run_ = 0, kept_asleep_ = 0, kept_sampled_ = 0;
  TaskTimes times_;
};

}  // namespace sluice
