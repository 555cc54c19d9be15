// The initial state slab by slab: its rates give the first step.
#include "app/plan/first_step_limit.hpp"

#include <algorithm>

namespace sluice {

StepLimit first_step_limit(const Component& component, const Level& level) {
  constexpr std::int64_t slab_cells = 1'000'000;
  Reductions rates(component.step().reductions().maxima(), component.step().reductions().sums());
  int along = 2;
  while (along > 0 && level.domain.size()[along] == 1) --along;
  const auto pieces = static_cast<int>(std::clamp<std::int64_t>(
      level.domain.volume() / slab_cells + 1, 1, level.domain.size()[along]));
  IntVec3 cut{1, 1, 1};
  cut[along] = pieces;
  for (const IndexBox& slab : split(level.domain, cut)) {
    Level part = level;
    part.boxes = {{slab, 0, 0}};
    Warehouse state(part, 0);
    for (SlotInfo s : component.state().slots()) {
      s.ghosts = 0;
      state.add(s);
    }
    component.state().initialise(state);
    component.step().measure_rates(state, rates);
  }
  std::vector<double> maxima;
  for (int m = 0; m < rates.maxima_count(); ++m) maxima.push_back(rates.maximum(m));
  return component.step().limit(maxima);
}

}  // namespace sluice
