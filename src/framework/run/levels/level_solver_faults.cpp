// Cells that are no state: found on all ranks, masked for another attempt.
#include <algorithm>
#include <cmath>
#include <string>

#include "framework/base/reduction.hpp"
#include "framework/run/levels/level_solver.hpp"

namespace sluice {

// Rare: the lowest of the cells that ranks have found.
CellFault LevelSolver::lowest_of_ranks(bool found, const CellFault& lowest) {
  std::string mine;
  if (found) mine.assign(reinterpret_cast<const char*>(&lowest), sizeof lowest);
  bool first = true;
  CellFault lowest_of_all = lowest;
  for (const std::string& text : communicator_->gather_to_all(mine)) {
    if (text.size() != sizeof(CellFault)) continue;
    CellFault f;
    std::copy(text.begin(), text.end(), reinterpret_cast<char*>(&f));
    if (first || before(f, lowest_of_all)) lowest_of_all = f;
    first = false;
  }
  return lowest_of_all;
}

std::optional<UnsoundCell> LevelSolver::unsound_start() {
  CellFault lowest;
  std::int64_t found = 0;
  for (const int slot : state_slots_)
    for (int b = 0; b < static_cast<int>(state_.local_boxes().size()); ++b)
      for (int c = 0; c < state_.info(slot).components; ++c) {
        const RealView v = state_.view(slot, c, b);
        for_each_cell(state_.local_boxes()[b].cells, [&](IntVec3 cell) {
          if (std::isfinite(v(cell))) return;
          const CellFault f{cell, level_.index, state_.info(slot).material, slot, v(cell)};
          if (found == 0 || before(f, lowest)) lowest = f;
          ++found;
        });
      }
  Reduction all;
  const auto count = all.add_count(found);
  communicator_->reduce(all);
  if (all.count(count) == 0) return std::nullopt;
  lowest = lowest_of_ranks(found > 0, lowest);
  return UnsoundCell{lowest, state_.info(lowest.kind).label};
}

std::int64_t LevelSolver::mask_faults() {
  add_state_slot({component_->mask_label(), 0, 1, 0});
  const int slot = state_.find(component_->mask_label(), 0);
  if (!masked_)
    for (int b = 0; b < static_cast<int>(state_.local_boxes().size()); ++b) {
      const RealView v = state_.view(slot, 0, b);
      fill(v, v.box, 1.0);
    }
  std::int64_t now = 0;
  for (const CellFault& f : last_.faults())
    for (int b = 0; b < static_cast<int>(state_.local_boxes().size()); ++b) {
      if (!state_.local_boxes()[b].cells.contains(f.cell)) continue;
      double& mask = state_.view(slot, 0, b)(f.cell);
      now += mask != 0.0;
      mask = 0.0;
    }
  const auto over_ranks = [&](std::int64_t count) {
    Reduction all;
    const auto sum = all.add_count(count);
    communicator_->reduce(all);
    return all.count(sum);
  };
  now = over_ranks(now);
  halo_->run(state_, {slot}, team_.get());
  if (now == 0 && attempt_.faults > 0) {
    now = over_ranks(widen_masks(slot));
    halo_->run(state_, {slot}, team_.get());
  }
  spread_masks(slot);
  masked_ = true;
  return now;
}

// Outside the domain as in its nearest cell.
void LevelSolver::spread_masks(int slot) {
  const IndexBox& domain = level_.domain;
  for (int b = 0; b < static_cast<int>(state_.local_boxes().size()); ++b) {
    const RealView mask = state_.view(slot, 0, b);
    for_each_cell(mask.box, [&](IntVec3 c) {
      IntVec3 inside = c;
      for (int d = 0; d < 3; ++d)
        if (!level_.periodic[d]) inside[d] = std::clamp(c[d], domain.lower[d], domain.upper[d] - 1);
      if (inside != c) mask(c) = mask(inside);
    });
  }
}

// By one cell along each direction: what flows into a cell has the slopes of its neighbours. All
// cells are found before the first is masked: boxes may share the cells beside them.
std::int64_t LevelSolver::widen_masks(int slot) {
  const int boxes = static_cast<int>(state_.local_boxes().size());
  std::vector<std::vector<IntVec3>> next(boxes);
  std::int64_t found = 0;
  for (int b = 0; b < boxes; ++b) {
    const RealView mask = state_.view(slot, 0, b);
    for_each_cell(state_.local_boxes()[b].cells, [&](IntVec3 c) {
      bool beside = false;
      for (int d = 0; d < 3; ++d) {
        if (!level_.active[d]) continue;
        for (const int step : {-1, 1}) {
          IntVec3 other = c;
          other[d] += step;
          beside = beside || mask(other) == 0.0;
        }
      }
      if (beside && mask(c) != 0.0) next[b].push_back(c);
    });
  }
  for (int b = 0; b < boxes; ++b) {
    const RealView mask = state_.view(slot, 0, b);
    for (const IntVec3 c : next[b]) mask(c) = 0.0;
    found += static_cast<std::int64_t>(next[b].size());
  }
  return found;
}

}  // namespace sluice
