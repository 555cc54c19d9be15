// Which directions are dimensions of the run.
#include "framework/scene/directions.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace sluice {

namespace {

enum class SideNature { symmetric, zero_gradient, other };

// What a whole side is, for every variable that has a condition there. A side without any counts as
// symmetric: components that need conditions refuse it anyway.
SideNature nature_of(const BoundarySide& side) {
  if (side.regions.empty()) return SideNature::other;
  bool symmetric = true, zero_gradient = true;
  for (const BoundaryRegion& region : side.regions) {
    for (const Condition& c : region.conditions) {
      // A specific volume from the density follows what the density does.
      if (c.kind == ConditionKind::compute_from_density) continue;
      symmetric = symmetric && c.kind == ConditionKind::symmetry;
      zero_gradient = zero_gradient && c.zero_gradient();
    }
  }
  return symmetric       ? SideNature::symmetric
         : zero_gradient ? SideNature::zero_gradient
                         : SideNature::other;
}

int cells_in(const GridSettings& grid, int d) {
  int low = grid.levels.front().boxes.front().cells.lower[d];
  int high = grid.levels.front().boxes.front().cells.upper[d];
  for (const BoxSettings& b : grid.levels.front().boxes) {
    low = std::min(low, b.cells.lower[d]);
    high = std::max(high, b.cells.upper[d]);
  }
  return high - low;
}

ActiveDirection stays(std::string reason, const Location& where) {
  return {true, VelocityComponent::solved, std::move(reason), where};
}

ActiveDirection judge(int d, const GridSettings& grid, const BoundaryConditions& boundary,
                      const DirectionFacts& facts) {
  const LevelSettings& level = grid.levels.front();
  const Location& box = level.boxes.front().where;
  const int cells = cells_in(grid, d);
  if (cells > 1) return stays(fmt::format("{} cells", cells), box);
  for (const LevelSettings& l : grid.levels)
    if (l.ratio[d] != 1) return stays("refined on a finer level", l.where);

  const BoundarySide& low = boundary.side(side_of(d, false));
  const BoundarySide& high = boundary.side(side_of(d, true));
  const SideNature nature = nature_of(low);
  std::string between;
  Location where = level.where;
  if (low.periodic) {
    between = "periodic";
  } else {
    where = low.regions.front().where;
    if (nature == SideNature::other || nature_of(high) != nature)
      return stays(fmt::format("one cell, but {}- and {}+ are not both symmetric, periodic or "
                               "zero-gradient",
                               axis_letter[d], axis_letter[d]),
                   where);
    between = nature == SideNature::symmetric ? "symmetric" : "zero-gradient";
  }
  const bool symmetric = !low.periodic && nature == SideNature::symmetric;
  if (facts.gravity[d] != 0)
    return stays(fmt::format("one cell between {} faces, but gravity acts along it", between),
                 where);
  if (facts.moving[d] && symmetric)
    return stays("one cell between symmetric faces, but a velocity along it is not zero",
                 facts.moving_where[d]);
  if (facts.force_all)
    return stays(
        fmt::format(
            "one cell between {} faces, but --force-directions makes every direction active",
            between),
        where);
  return {false, facts.moving[d] ? VelocityComponent::carried : VelocityComponent::dropped,
          fmt::format("one cell between {} faces", between), where};
}

}  // namespace

std::array<ActiveDirection, 3> find_active_directions(const GridSettings& grid,
                                                      const BoundaryConditions& boundary,
                                                      const DirectionFacts& facts) {
  std::array<ActiveDirection, 3> result = {judge(0, grid, boundary, facts),
                                           judge(1, grid, boundary, facts),
                                           judge(2, grid, boundary, facts)};
  if (!result[0].active && !result[1].active && !result[2].active)
    result[0] = stays("one cell in every direction; at least one direction must be active",
                      result[0].where);
  return result;
}

}  // namespace sluice
