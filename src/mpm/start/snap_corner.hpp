// Moving a corner of a lattice onto the surface of the piece that the lattice fills. Places and
// edges in m.
#pragma once
#include <array>

#include "framework/geometry/piece.hpp"

namespace sluice::mpm {

// A point where parts of a lattice meet, some of which hold a particle.
struct LatticeCorner {
  Vec3 place{};
  Vec3 step{};                  // edges of a part
  std::array<int, 3> active{};  // directions, rising; `count` of them
  int count = 3;
  unsigned filled = 0;          // bit k: the part on the sides k (a bit an active direction)
  std::array<bool, 3> fixed{};  // directions along which the place must stay
};

// The place on the surface, at most half a diagonal of a part away; else the corner's own place.
// - Where the parts that are filled (or those that are not) lie on one side of some directions, the
//   corner goes to where lines from the filled parts along these cross the surface, as on a box:
//   kept if the surface is square there, or if it is one direction alone.
// - Else along the normal, which is that of a weighted count of points around the corner.
// Roots are found by bisection on inside(). It depends on the corner alone, and mirrored corners of
// a mirrored piece have mirrored places.
Vec3 on_surface(const GeometryPiece& piece, const LatticeCorner& corner);

}  // namespace sluice::mpm
