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

}  // namespace sluice
