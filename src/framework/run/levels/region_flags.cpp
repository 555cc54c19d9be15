// Regions as bits of a level's cells, filled in as boxes come to hold them.
#include "framework/run/levels/region_flags.hpp"

#include <algorithm>
#include <cmath>

namespace sluice {
namespace {

using Word = std::uint64_t;

// Cells whose centres may lie between two coordinates, with one cell to spare for round-off.
IndexBox cells_of(const Bounds& bounds, const Level& level) {
  IndexBox cells = level.domain;
  for (int d = 0; d < 3; ++d) {
    const auto index = [&](double x) {
      const double i = std::floor((x - level.anchor[d]) / level.spacing[d] - 0.5);
      return static_cast<int>(std::clamp(i, -1e9, 1e9));
    };
    cells.lower[d] = std::max(cells.lower[d], index(bounds.lower[d]) - 1);
    cells.upper[d] = std::min(cells.upper[d], index(bounds.upper[d]) + 3);
  }
  return cells;
}

}  // namespace

RegionFlags::RegionFlags(const std::vector<RefinedRegion>& regions, const Level& level)
    : level_(level) {
  level_.boxes.clear();
  for (const RefinedRegion& r : regions) {
    if (r.finest_level <= level.index) continue;
    const IndexBox cells = cells_of(r.piece->bounds(), level);
    if (cells.empty()) continue;
    regions_.push_back({r.piece, cells, FlagField(cells), FlagField(cells)});
  }
}

void RegionFlags::look(Region& region, const IndexBox& cells) {
  const IntVec3 low = cells.lower - region.cells.lower, high = cells.upper - region.cells.lower;
  for (int z = low.z; z < high.z; ++z)
    for (int y = low.y; y < high.y; ++y) {
      const Word* known = region.known.row(y, z);
      for (int x = next_gap(known, low.x, high.x); x < high.x; x = next_gap(known, x + 1, high.x)) {
        const IntVec3 cell = region.cells.lower + IntVec3{x, y, z};
        ++looked_at_;
        if (region.piece->inside(level_.centre(cell))) region.inside.set(cell);
      }
    }
  region.known.fill(cells);
}

void RegionFlags::add(const IndexBox& cells, FlagField& flags) {
  for (Region& region : regions_) {
    const IndexBox part = intersection(cells, region.cells);
    if (part.empty()) continue;
    look(region, part);
    const IntVec3 low = part.lower - region.cells.lower, high = part.upper - region.cells.lower;
    for (int z = low.z; z < high.z; ++z)
      for (int y = low.y; y < high.y; ++y) {
        const Word* inside = region.inside.row(y, z);
        for (int x = next_flag(inside, low.x, high.x); x < high.x;) {
          const int end = next_gap(inside, x, high.x);
          IndexBox run{region.cells.lower + IntVec3{x, y, z}, region.cells.lower};
          run.upper = run.upper + IntVec3{end, y + 1, z + 1};
          flags.fill(run);
          x = next_flag(inside, end, high.x);
        }
      }
  }
}

}  // namespace sluice
