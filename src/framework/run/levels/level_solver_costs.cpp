// What a level has cost so far: time and tasks by effect, blocks, memory, messages.
#include <algorithm>
#include <set>
#include <utility>

#include "framework/run/levels/level_solver_variant.hpp"

namespace sluice {

std::vector<double> LevelSolver::effect_seconds() const {
  std::vector<double> seconds(component_->effects().size(), 0.0);
  for (const auto& [key, v] : variants_)
    for (int kind = 0; kind < v->executor->kinds(); ++kind) {
      if (!v->executor->met(kind)) continue;
      const TaskList& list = v->executor->list(kind);
      const SweepPlan& plan = v->executor->plan(kind);
      const std::vector<double> tasks = v->executor->task_seconds(kind);
      for (std::size_t t = 0; t < tasks.size(); ++t) {
        const std::size_t task = plan.tasks[t].task;
        seconds[list.tasks()[task].effect] += tasks[t];
      }
    }
  return seconds;
}

std::vector<int> LevelSolver::effect_tasks() const {
  std::vector<int> most(component_->effects().size(), 0);
  const auto plain = variants_.find({false, {}});
  if (plain == variants_.end()) return most;
  SweepExecutor& executor = *plain->second->executor;
  for (int kind = 0; kind < executor.kinds(); ++kind) {
    if (!executor.met(kind)) continue;
    std::vector<int> count(most.size(), 0);
    for (const PlannedTask& p : executor.plan(kind).tasks)
      ++count[executor.list(kind).tasks()[p.task].effect];
    for (std::size_t e = 0; e < most.size(); ++e) most[e] = std::max(most[e], count[e]);
  }
  return most;
}

std::vector<double> LevelSolver::effect_doubles() const {
  std::vector<double> doubles(component_->effects().size(), 0.0);
  const auto plain = variants_.find({false, {}});
  if (plain == variants_.end()) return doubles;
  SweepExecutor& executor = *plain->second->executor;
  std::set<std::pair<Label, int>> counted;  // kinds write the same slots
  for (int kind = executor.kinds() - 1; kind >= 0; --kind) {
    if (!executor.met(kind)) continue;
    const TaskList& list = executor.list(kind);
    for (const Task& t : list.tasks())
      for (VariableId v : t.writes)
        if (executor.plan(kind).used[v.index] && list[v].storage == Storage::new_state &&
            counted.insert({list[v].label, list[v].material}).second)
          doubles[t.effect] += 2.0 * list[v].components;  // old and new
  }
  return doubles;
}

std::vector<double> LevelSolver::box_seconds() const {
  std::vector<double> seconds(state_.local_boxes().size(), 0.0);
  for (const auto& [key, v] : variants_) {
    if (v->boxes != boxes_) continue;
    const std::vector<double> own = v->executor->box_seconds();
    for (std::size_t b = 0; b < own.size(); ++b) seconds[b] += own[b];
  }
  return seconds;
}

std::int64_t LevelSolver::blocks_run() const {
  std::int64_t n = 0;
  for (const auto& [key, v] : variants_) n += v->executor->blocks_run();
  return n;
}

std::int64_t LevelSolver::blocks_skipped() const {
  std::int64_t n = 0;
  for (const auto& [key, v] : variants_) n += v->executor->blocks_skipped();
  return n;
}

std::int64_t LevelSolver::cells_skipped() const {
  std::int64_t n = 0;
  for (const auto& [key, v] : variants_) n += v->executor->cells_skipped();
  return n;
}

std::size_t LevelSolver::memory_bytes() const {
  std::size_t n = state_.bytes() + next_.bytes() + start_.bytes() + outputs_.bytes();
  for (const auto& [key, v] : variants_) n += v->executor->scratch_bytes();
  for (const auto* some : {&diagnostics_, &preparations_})
    for (const auto& [key, v] : *some) n += v->executor->scratch_bytes();
  return n;
}

std::size_t LevelSolver::message_bytes() const {
  int components = 0;
  for (int s : state_slots_) components += state_.info(s).components;
  return halo_->message_bytes(components);
}

std::int64_t LevelSolver::blocks_run(int kind) const {
  std::int64_t n = 0;
  for (const auto& [key, v] : variants_) n += v->executor->blocks_run(kind);
  return n;
}

}  // namespace sluice
