// The longest step in which no solid gains energy, as a share of h/(c + |v|).
//
// Forces act on velocities of particles, strain is taken from those of nodes, and nodes at a
// surface have a part of the mass of an inner one but more of its stiffness. What is left of the
// classic limit depends on the basis, on the number of particles of a cell in a direction, and on
// the directions of the run. Measured with bars and blocks that drift and vibrate
// (stable_step_test.cpp; docs/theory/mpm_step.md).
// M. Berzins, Nonlinear stability and time step selection for the MPM method, Comput. Part. Mech. 5
// (2018) 455; P. C. Wallstedt, J. E. Guilkey, J. Comput. Phys. 227 (2008) 9628, section 4.
#pragma once
#include <array>
#include <string>

#include "mpm/deck/mpm_scene.hpp"

namespace sluice::mpm {

struct StableShare {
  double share = 1;    // of h/(c + |v|)
  std::string reason;  // "GIMP with 2 particles per cell and direction"
};

// The least over the materials that deform.
StableShare stable_share(const MpmScene& solids, const std::array<bool, 3>& active);

}  // namespace sluice::mpm
