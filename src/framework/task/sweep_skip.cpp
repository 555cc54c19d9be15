// Blocks whose state is uniform as far as they see: nothing happens in them.
#include "framework/field/array_view.hpp"
#include "framework/task/sweep_worker.hpp"

namespace sluice {

bool SweepExecutor::is_skippable(const Graph& graph, const Block& block) const {
  for (VariableId id : graph.plan.states_read) {
    const Variable& variable = (*graph.list)[id];
    const int slot = graph.binding.slot[id.index];
    for (int c = 0; c < variable.components; ++c) {
      const RealView v = old_state_->view(slot, c, block.box);
      const IndexBox seen = intersection(block.cells.grown(graph.plan.halo), v.box);
      if (any_other(v, seen, v(seen.lower))) return false;
    }
  }
  return true;
}

void SweepExecutor::skip(Worker& worker, const StepConstants& step, const Block& block) {
  const Graph& graph = *graphs_[block.kind];
  BlockSweep& sweep = *worker.sweeps[block.kind];
  if (RowMarks* marks = new_state_->marks(block.box)) marks->clear(block.cells);
  // Peel off the cells along the boundary of the domain, side by side, each cell once.
  IndexBox rest = block.cells;
  for (int a = 0; a < graph.plan.axes.count && !rest.empty(); ++a) {
    const int d = graph.plan.axes.direction[a];
    if (level_->periodic[d]) continue;
    if (rest.lower[d] == level_->domain.lower[d]) {
      IndexBox strip = rest;
      strip.upper[d] = strip.lower[d] + 1;
      sweep.run(step, block.box, strip, worker.reductions);
      rest.lower[d] += 1;
    }
    if (!rest.empty() && rest.upper[d] == level_->domain.upper[d]) {
      IndexBox strip = rest;
      strip.lower[d] = strip.upper[d] - 1;
      sweep.run(step, block.box, strip, worker.reductions);
      rest.upper[d] -= 1;
    }
  }
  if (rest.empty()) return;
  sweep.run(step, block.box, {rest.lower, rest.lower + IntVec3{1, 1, 1}}, worker.reductions);
  worker.skipped.cells += rest.volume() - 1;
  for (std::size_t v = 0; v < graph.list->variables().size(); ++v) {
    const Variable& variable = graph.list->variables()[v];
    if (variable.storage != Storage::new_state || !graph.plan.used[v]) continue;
    const int from = old_state_->find(variable.label, variable.material);
    for (int c = 0; c < variable.components; ++c) {
      const RealView old = old_state_->view(from, c, block.box);
      const RealView now = new_state_->view(graph.binding.slot[v], c, block.box);
      fill(now, rest, old(rest.lower));
    }
  }
}

}  // namespace sluice
