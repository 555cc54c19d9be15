#include "mpm/levels/fine_region.hpp"

#include <algorithm>

#include "framework/grid/grid_boxes.hpp"

namespace sluice::mpm {
FineRegion::FineRegion(const Level& fine) : level_(fine), finder_(cells_of(fine.boxes)) {}

// Cells that touch the nodes [low, high), in the domain.
IndexBox FineRegion::cells_around(IntVec3 low, IntVec3 high) const {
  IndexBox cells{low, high};
  for (int d = 0; d < 3; ++d) {
    if (!level_.active[d]) {
      cells.lower[d] = level_.domain.lower[d];
      cells.upper[d] = level_.domain.upper[d];
      continue;
    }
    const int first = level_.domain.lower[d], last = level_.domain.upper[d] - 1;
    cells.lower[d] = std::clamp(low[d] - 1, first, last);
    cells.upper[d] = std::clamp(high[d] - 1, first, last) + 1;
  }
  return cells;
}

bool FineRegion::all_inside(IntVec3 low, IntVec3 high) const {
  return finder_.covers(cells_around(low, high));
}

bool FineRegion::meets_coarse(IntVec3 low, IntVec3 high) const {
  IntVec3 from = low, to = high;
  for (int d = 0; d < 3; ++d) {
    from[d] = low[d] * level_.ratio[d];
    to[d] = (high[d] - 1) * level_.ratio[d] + 1;
  }
  return !finder_.overlapping(cells_around(from, to)).empty();
}

}  // namespace sluice::mpm
