// Regions without holes, cut into few boxes with long rows; images of a region under periods.
#pragma once
#include <vector>

#include "framework/grid/box_list.hpp"
#include "framework/grid/level.hpp"

namespace sluice {

// The direction along which rows run: the first active one.
int row_direction(const std::array<bool, 3>& active);

// Disjoint boxes that make up `region` without all `holes` (which may overlap), as whole rows.
// Takes near n log n for n holes on a lattice of tiles.
std::vector<IndexBox> pieces_without(const IndexBox& region, std::vector<IndexBox> holes, int row);

// Joins boxes that share a whole side, first along `row`. They must be disjoint.
std::vector<IndexBox> joined(std::vector<IndexBox> boxes, int row);

// Shifts by whole periods that carry `region` to where it overlaps the domain grown by `reach`
// layers in active directions; sorted, and the same whatever the boxes are.
std::vector<IntVec3> image_shifts(const Level& level, const IndexBox& region, int reach);

// Parts of `region` that no box of the level holds, not even as a periodic image. `finder` holds
// the boxes' cells.
std::vector<IndexBox> pieces_without_level(const IndexBox& region, const Level& level,
                                           const BoxFinder& finder);

}  // namespace sluice
