// Force of a side of the domain on a solid, and the area over which the solid touches it.
//
//   F = sum_p V sigma . D_p,   A = sum_p 2 V w_p/h
//
// w is the weight of a particle on the nodes of the side, which along the side add up to that of
// the normal direction alone; D is its gradient. So F is minus the internal force of these
// nodes. Of
// the nodes beyond (of wide shape functions) a wall takes the force whole; a mirror throws it back:
// its normal part counts twice, the tangential one stays with the body.
#pragma once
#include "framework/grid/level.hpp"
#include "framework/grid/side.hpp"
#include "framework/particle/particle_set.hpp"
#include "framework/run/component/conservation.hpp"
#include "mpm/step/columns.hpp"

namespace sluice::mpm {

// Whether a side of the domain is a mirror for a material (local number).
bool is_mirror(const MpmScene& solids, Side side, int material);

// Adds the particles of a set; `force` has three totals (N), `area` one (m^2), null: not wanted.
void add_face(const MpmScene& solids, const Level& level, Side side, bool mirror,
              const ParticleSet& set, const Carried& carried, ConservedTotal* force,
              ConservedTotal* area);

}  // namespace sluice::mpm
