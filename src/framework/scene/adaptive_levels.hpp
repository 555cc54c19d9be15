// Levels that a regridder may make, and what every finer level must obey.
//
// Refinement ratios are 1, 2 or 4 a direction, 1 in a direction that is not a dimension of the run,
// and not 1 in all others. Around a level lies at least one cell of the next coarser one (or the
// domain's boundary), so that no level ever touches one that is two coarser.
#pragma once
#include <array>
#include <vector>

#include "framework/deck/deck.hpp"
#include "framework/scene/grid_settings.hpp"

namespace sluice {

// What the deck says of the levels to come; lists may be shorter than max_levels - 1, then their
// last entry holds for all further levels.
struct AdaptiveLevels {
  int max_levels = 1;
  std::vector<IntVec3> ratios, tiles;
  Location ratio_where, tile_where;
};

// The static levels of <Grid>: their ratios, and the margins around them.
void check_static_levels(const GridSettings& grid, const std::array<bool, 3>& active,
                         std::vector<Fault>& faults);

// Adds the levels above the one of `grid`, without boxes, and returns the tile of each level (that
// of level 0 unused). With a fault nothing is added.
std::vector<IntVec3> add_adaptive_levels(const AdaptiveLevels& levels,
                                         const std::array<bool, 3>& active, GridSettings& grid,
                                         std::vector<Fault>& faults);

// All cells of a level of `grid`, whether it has boxes or not.
IndexBox domain_of(const GridSettings& grid, std::size_t level);

}  // namespace sluice
