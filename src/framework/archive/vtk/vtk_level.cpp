// Ratios of all directions made equal by thin copies of cells.
#include "framework/archive/vtk/vtk_level.hpp"

#include <algorithm>

#include "framework/grid/box_list.hpp"

namespace sluice {
namespace {

// The ratio of the directions that are refined; 0 when they are refined unequally.
int common_ratio(const Level& level) {
  int ratio = 0;
  for (int d = 0; d < 3; ++d) {
    if (level.domain.size()[d] == 1) continue;
    if (ratio != 0 && level.ratio[d] != ratio) return 0;
    ratio = level.ratio[d];
  }
  return std::max(ratio, 1);
}

}  // namespace

IndexBox VtkLevel::spread(const IndexBox& box) const {
  return refine(box, copies);
}

IntVec3 VtkLevel::source(IntVec3 c) const {
  return coarsen(c, copies);
}

bool fits_vtk_amr(const Grid& grid) {
  return std::all_of(grid.levels.begin(), grid.levels.end(), [](const Level& level) {
    return level.index == 0 || common_ratio(level) > 0;
  });
}

std::vector<VtkLevel> vtk_amr_levels(const Grid& grid) {
  std::vector<VtkLevel> levels;
  IntVec3 copies{1, 1, 1};
  for (const Level& level : grid.levels) {
    const int ratio = level.index > 0 ? common_ratio(level) : 1;
    for (int d = 0; d < 3; ++d) copies[d] *= ratio / level.ratio[d];
    levels.push_back({level, copies});
    for (int d = 0; d < 3; ++d) levels.back().level.spacing[d] /= copies[d];
  }
  return levels;
}

}  // namespace sluice
