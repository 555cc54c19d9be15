// Graphs as they are bound, and what a thread works with; for the files of SweepExecutor alone.
#pragma once
#include "framework/task/sweep_executor.hpp"

namespace sluice {

// What was counted and timed of one kind.
struct SweepExecutor::SweepCounts {
  std::int64_t run = 0, sampled = 0;
  TaskTimes times;

  void add(const SweepCounts& other) {
    run += other.run;
    sampled += other.sampled;
    if (times.size() < other.times.size()) times.resize(other.times.size(), 0);
    for (std::size_t t = 0; t < other.times.size(); ++t) times[t] += other.times[t];
  }
};

// A graph as it is bound to warehouses.
struct SweepExecutor::Graph {
  explicit Graph(SweepGraph g)
      : list(g.list),
        plan(std::move(g.plan)),
        absent(std::move(g.absent)),
        may_be_skipped(g.may_be_skipped) {
    kept.times.assign(plan.tasks.size(), 0);
  }
  const TaskList* list;
  SweepPlan plan;
  std::vector<AbsentSlot> absent;
  bool may_be_skipped;
  StateBinding binding;
  std::vector<int> written;       // slots of the new state
  std::vector<int> absent_slots;  // of `absent`, in the new state or among the outputs
  SweepCounts kept;               // before the workers were made anew
};

struct SweepExecutor::Worker {
  Worker(int kinds, const SweepOptions& o)
      : sweeps(kinds), counts(kinds), reductions(o.maxima, o.sums) {}
  std::shared_ptr<AlignedArray> scratch = std::make_shared<AlignedArray>();
  std::vector<std::unique_ptr<BlockSweep>> sweeps;  // by kind
  std::vector<SweepCounts> counts;                  // by kind
  Reductions reductions;
  TaskTimes boxes;                 // by local box
  std::vector<SweepPiece> pieces;  // awake, of one kind, to be swept as one
  Skipped skipped;
};

}  // namespace sluice
