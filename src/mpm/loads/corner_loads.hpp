// Loads on the corners of particles: the force of a surface, a quarter on each corner of that
// face of
// the particle that lies in the surface. It follows the area of the face:
//
//   f_c = f/4 |e_a x e_b|/|e_a x e_b|_0 at x + s e_n/2 +- e_a/2 +- e_b/2,   e = F e_0 the edges
//
// (Convected particle domains of boundaries, CBDI.) Sharper than forces in the middle of particles,
// which lie inside of the surface.
#pragma once
#include <array>

#include "solids/corner_force.hpp"

namespace sluice::mpm {

using solids::CornerForce;

// The face that looks along the unit vector n; `edges` (m) of the particle now, `rest` at rest.
std::array<CornerForce, 4> corner_forces(Vec3 x, Vec3 force, Vec3 n,
                                         const std::array<Vec3, 3>& edges,
                                         const std::array<Vec3, 3>& rest);

}  // namespace sluice::mpm
