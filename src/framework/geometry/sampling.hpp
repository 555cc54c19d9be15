// How much of a cell a piece fills, by counting sub-points. Points and spacings in m.
//
// Sub-point s (0 <= s < res) of cell i lies at  centre(i) + (2 s + 1 - res) dx / (2 res), with
// centre(i) = anchor + (i + 1/2) dx. The offset changes sign when s and res-1-s change places, so
// on a domain centred at zero whose spacing is a power of two a mirrored piece gives mirrored
// counts to the bit: every operation on the mirrored point gives the negated or the same number.
#pragma once
#include <cstdint>
#include <vector>

#include "framework/geometry/piece.hpp"

namespace sluice {

struct CellLattice {
  Vec3 anchor{}, spacing{1, 1, 1};

  double centre(int direction, int i) const {
    return anchor[direction] + (i + 0.5) * spacing[direction];
  }
  double sub_point(int direction, int i, int s, int res) const {
    return centre(direction, i) + ((2 * s + 1 - res) * spacing[direction]) / (2 * res);
  }
  IntVec3 cell_of(Vec3 p) const;  // floor((p - anchor) / spacing)
};

// Number of sub-points of one cell that lie inside; at most res.x res.y res.z. Of a piece that is a
// list of points: how many of them lie in the cell, whatever res says.
std::int32_t count_inside(const GeometryPiece&, const CellLattice&, IntVec3 cell, IntVec3 res);

// The same for every cell of [lower, upper), x fastest. Blocks of cells that the piece covers
// wholly or not at all are settled without looking at a sub-point.
std::vector<std::int32_t> count_inside(const GeometryPiece&, const CellLattice&, IntVec3 lower,
                                       IntVec3 upper, IntVec3 res);

// Whether a sub-point of any cell of [lower, upper) lies inside; ends at the first that does.
bool any_inside(const GeometryPiece&, const CellLattice&, IntVec3 lower, IntVec3 upper,
                IntVec3 res);

}  // namespace sluice
