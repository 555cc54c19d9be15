// Finding the box of a position.
#include "framework/particle/particle_map.hpp"

#include <algorithm>
#include <cmath>

#include "framework/grid/grid_boxes.hpp"

namespace sluice {

IntVec3 cell_at(const Level& level, Vec3 point) {
  IntVec3 cell = level.domain.lower;
  for (int d = 0; d < 3; ++d)
    if (level.active[d])
      cell[d] = static_cast<int>(std::floor((point[d] - level.anchor[d]) / level.spacing[d]));
  return cell;
}

ParticleMap::ParticleMap(std::vector<Level> levels) : levels_(std::move(levels)) {
  for (const Level& level : levels_) finders_.emplace_back(cells_of(level.boxes));
  for (std::size_t l = 0; l < levels_.size(); ++l) {
    auto& of_level = finer_.emplace_back();
    for (const GridBox& b : levels_[l].boxes) {
      auto& above = of_level.emplace_back();
      if (l + 1 == levels_.size()) continue;
      const BoxFinder& finder = finders_[l + 1];
      for (const int n : finder.overlapping(refine(b.cells, levels_[l + 1].ratio)))
        above.push_back(finder.boxes()[n]);
    }
  }
}

ParticleMap::Home ParticleMap::find(Vec3 point) const {
  for (std::size_t l = levels_.size(); l-- > 0;) {
    const IntVec3 cell = cell_at(levels_[l], point);
    const std::vector<int> found = finders_[l].overlapping({cell, cell + IntVec3::all(1)});
    if (found.empty()) continue;
    const GridBox& box = levels_[l].boxes[found.front()];
    return {static_cast<int>(l), box.id, box.owner};
  }
  return {};
}

bool ParticleMap::is_home(int level, int box, Vec3 point) const {
  const std::size_t l = level, b = box;
  if (!levels_[l].boxes[b].cells.contains(cell_at(levels_[l], point))) return false;
  const std::vector<IndexBox>& finer = finer_[l][b];
  if (finer.empty()) return true;
  const IntVec3 cell = cell_at(levels_[l + 1], point);
  return std::none_of(finer.begin(), finer.end(),
                      [&](const IndexBox& cells) { return cells.contains(cell); });
}

// The owners of all boxes that overlap a region of a level. Regions and boxes of two levels meet in
// cells of the finer one, so that it does not matter which of both was grown.
void ParticleMap::add_ranks_near(std::size_t level, const IndexBox& grown,
                                 std::vector<int>& ranks) const {
  IndexBox region = grown;
  const auto add = [&](std::size_t l) {
    for (const int n : finders_[l].overlapping(region)) ranks.push_back(levels_[l].boxes[n].owner);
  };
  add(level);
  for (std::size_t l = level; l-- > 0;) {
    region = coarsen(region, levels_[l + 1].ratio);
    add(l);
  }
  region = grown;
  for (std::size_t l = level + 1; l < levels_.size(); ++l) {
    region = refine(region, levels_[l].ratio);
    add(l);
  }
}

std::vector<int> ParticleMap::ranks_near(int rank, int reach) const {
  std::vector<int> ranks;
  IntVec3 layers = IntVec3::all(reach);
  for (std::size_t l = 0; l < levels_.size(); ++l) {
    const Level& level = levels_[l];
    if (l > 0) layers = layers * level.ratio;
    const IntVec3 size = level.domain.size();
    const IntVec3 turns{level.periodic[0], level.periodic[1], level.periodic[2]};
    for (const GridBox& box : level.boxes) {
      if (box.owner != rank) continue;
      for (int k = -turns.z; k <= turns.z; ++k)
        for (int j = -turns.y; j <= turns.y; ++j)
          for (int i = -turns.x; i <= turns.x; ++i) {
            const IntVec3 by = IntVec3{i, j, k} * size;
            add_ranks_near(l, {box.cells.lower - layers + by, box.cells.upper + layers + by},
                           ranks);
          }
    }
  }
  std::sort(ranks.begin(), ranks.end());
  ranks.erase(std::unique(ranks.begin(), ranks.end()), ranks.end());
  std::erase(ranks, rank);
  return ranks;
}

}  // namespace sluice
