// The part of a box that lies inside a piece: share of the volume, and centroid (m).
#pragma once
#include <array>

#include "framework/geometry/piece.hpp"

namespace sluice::mpm {

struct CutPart {
  double share = 0;  // of the box's volume, 0 to 1
  Vec3 centroid{};   // of the part; the middle of the box where the share is 0 or 1
};

// By lines along the direction that the surface crosses most; on each line crossings are found by
// bisection, to 1e-7 of the box. Directions that are not `active` are taken at the middle alone.
// The share of a box that a plane cuts is right to 1e-3, that of a curved surface likewise, where
// it is longer than a quarter of the box.
CutPart part_inside(const GeometryPiece& piece, const Bounds& box, std::array<bool, 3> active);

}  // namespace sluice::mpm
