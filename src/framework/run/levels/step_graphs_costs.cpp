// What the graphs of a level have cost so far: time and tasks by effect, blocks, memory.
#include <algorithm>
#include <set>
#include <utility>

#include "framework/run/levels/step_graphs_variant.hpp"

namespace sluice {

const StepGraphs::Variant* StepGraphs::plain() const {
  const auto found = variants_.find({Purpose::step, false, {}});
  return found == variants_.end() ? nullptr : found->second.get();
}

template <class Count>
std::int64_t StepGraphs::sum_over_steps(Count count) const {
  std::int64_t n = 0;
  for (const auto& [key, v] : variants_)
    if (key.purpose == Purpose::step) n += count(*v->executor);
  return n;
}

std::vector<double> StepGraphs::effect_seconds() const {
  std::vector<double> seconds(component_->effects().size(), 0.0);
  for (const auto& [key, v] : variants_)
    for (int kind = 0; key.purpose == Purpose::step && kind < v->executor->kinds(); ++kind) {
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

std::vector<int> StepGraphs::effect_tasks() const {
  std::vector<int> most(component_->effects().size(), 0);
  if (plain() == nullptr) return most;
  SweepExecutor& executor = *plain()->executor;
  for (int kind = 0; kind < executor.kinds(); ++kind) {
    if (!executor.met(kind)) continue;
    std::vector<int> count(most.size(), 0);
    for (const PlannedTask& p : executor.plan(kind).tasks)
      ++count[executor.list(kind).tasks()[p.task].effect];
    for (std::size_t e = 0; e < most.size(); ++e) most[e] = std::max(most[e], count[e]);
  }
  return most;
}

std::vector<double> StepGraphs::effect_doubles() const {
  std::vector<double> doubles(component_->effects().size(), 0.0);
  if (plain() == nullptr) return doubles;
  SweepExecutor& executor = *plain()->executor;
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

std::vector<double> StepGraphs::box_seconds() const {
  std::vector<double> seconds(states_->present().local_boxes().size(), 0.0);
  for (const auto& [key, v] : variants_) {
    if (key.purpose != Purpose::step || v->boxes != boxes_) continue;
    const std::vector<double> own = v->executor->box_seconds();
    for (std::size_t b = 0; b < own.size(); ++b) seconds[b] += own[b];
  }
  return seconds;
}

std::int64_t StepGraphs::blocks_run() const {
  return sum_over_steps([](const SweepExecutor& e) { return e.blocks_run(); });
}

std::int64_t StepGraphs::blocks_run(int kind) const {
  return sum_over_steps([kind](const SweepExecutor& e) { return e.blocks_run(kind); });
}

std::int64_t StepGraphs::blocks_skipped() const {
  return sum_over_steps([](const SweepExecutor& e) { return e.blocks_skipped(); });
}

std::int64_t StepGraphs::cells_skipped() const {
  return sum_over_steps([](const SweepExecutor& e) { return e.cells_skipped(); });
}

std::size_t StepGraphs::bytes() const {
  std::size_t n = outputs_.bytes();
  for (const auto& [key, v] : variants_) n += v->executor->scratch_bytes();
  return n;
}

}  // namespace sluice
