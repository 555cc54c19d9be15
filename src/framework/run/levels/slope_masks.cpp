#include "framework/run/levels/slope_masks.hpp"

#include <algorithm>
#include <vector>

#include "framework/base/reduction.hpp"

namespace sluice {

std::int64_t SlopeMasks::over_ranks(std::int64_t count) const {
  Reduction all;
  const auto sum = all.add_count(count);
  ranks_->reduce(all);
  return all.count(sum);
}

std::int64_t SlopeMasks::add(std::span<const CellFault> faults, std::int64_t count) {
  states_->add_slot({label_, 0, 1, 0});
  const Warehouse& state = states_->present();
  const int slot = state.find(label_, 0);
  if (!any_)
    for (int b = 0; b < static_cast<int>(state.local_boxes().size()); ++b) {
      const RealView v = state.view(slot, 0, b);
      fill(v, v.box, 1.0);
    }
  std::int64_t now = over_ranks(mask(faults, slot));
  ghosts_->exchange(slot);
  if (now == 0 && count > 0) {
    now = over_ranks(widen(slot));
    ghosts_->exchange(slot);
  }
  extend_outside(slot);
  any_ = true;
  return now;
}

std::int64_t SlopeMasks::mask(std::span<const CellFault> faults, int slot) {
  const Warehouse& state = states_->present();
  std::int64_t now = 0;
  for (const CellFault& f : faults)
    for (int b = 0; b < static_cast<int>(state.local_boxes().size()); ++b) {
      if (!state.local_boxes()[b].cells.contains(f.cell)) continue;
      double& there = state.view(slot, 0, b)(f.cell);
      now += there != 0.0;
      there = 0.0;
    }
  return now;
}

// Outside the domain as in its nearest cell.
void SlopeMasks::extend_outside(int slot) {
  const Warehouse& state = states_->present();
  const Level& level = states_->level();
  for (int b = 0; b < static_cast<int>(state.local_boxes().size()); ++b) {
    const RealView there = state.view(slot, 0, b);
    for_each_cell(there.box, [&](IntVec3 c) {
      IntVec3 inside = c;
      for (int d = 0; d < 3; ++d)
        if (!level.periodic[d])
          inside[d] = std::clamp(c[d], level.domain.lower[d], level.domain.upper[d] - 1);
      if (inside != c) there(c) = there(inside);
    });
  }
}

// By one cell along each direction: what flows into a cell has the slopes of its neighbours. All
// cells are found before the first is masked: boxes may share the cells beside them.
std::int64_t SlopeMasks::widen(int slot) {
  const Warehouse& state = states_->present();
  const Level& level = states_->level();
  const int boxes = static_cast<int>(state.local_boxes().size());
  std::vector<std::vector<IntVec3>> next(boxes);
  std::int64_t found = 0;
  for (int b = 0; b < boxes; ++b) {
    const RealView there = state.view(slot, 0, b);
    for_each_cell(state.local_boxes()[b].cells, [&](IntVec3 c) {
      bool beside = false;
      for (int d = 0; d < 3; ++d) {
        if (!level.active[d]) continue;
        for (const int step : {-1, 1}) {
          IntVec3 other = c;
          other[d] += step;
          beside = beside || there(other) == 0.0;
        }
      }
      if (beside && there(c) != 0.0) next[b].push_back(c);
    });
  }
  for (int b = 0; b < boxes; ++b) {
    const RealView there = state.view(slot, 0, b);
    for (const IntVec3 c : next[b]) there(c) = 0.0;
    found += static_cast<std::int64_t>(next[b].size());
  }
  return found;
}

}  // namespace sluice
