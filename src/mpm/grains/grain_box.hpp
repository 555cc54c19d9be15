// The box of a particle: what its mass fills where grains just touch.
#pragma once
#include <cstdint>
#include <vector>

#include "framework/grid/level.hpp"
#include "mpm/step/columns.hpp"

namespace sluice::mpm {

struct GrainBox {
  Vec3 place{}, half{};  // middle, half widths, m; half 0 along directions that are not active
  std::int64_t id = 0;
  std::int64_t label = 0;  // of its cluster: the smallest id in it
};

// Boxes of a set of particles, behind those that are there. With D active directions, the particle
// having the edges h R0 at the start,
//
//   width_d = |e_d . F h R0| (J_c/J)^(1/D),   J_c = rho_0/critical_density,
//
// so that a particle as dense as J_c has the extent of its deformed shape, a denser one more, a
// looser one less. Neighbours in a body that is deformed evenly are |e_d . F h R0 e_j| apart, which
// is no more than the width until J > J_c: whatever its shear, a body that is dense stays one.
//
// No width exceeds two cells: particles farther apart share hardly a node.
// `loosest`: J_c. `corners`: raised to how far corners of deformed particles may be from their
// middles, cells.
void add_grain_boxes(const ParticleSet& set, const Columns& columns, double loosest,
                     const Level& level, std::vector<GrainBox>& boxes, double& corners);

}  // namespace sluice::mpm
