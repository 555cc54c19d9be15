// Bodies of one material that do not touch and yet act on each other.
//
// A material has one velocity at a node. Bodies whose particles reach the same nodes across a gap
// of less than a cell move there as one: pushed before they meet, they do not part again.
#pragma once
#include <vector>

#include "framework/grid/level.hpp"
#include "mpm/deck/mpm_scene.hpp"

namespace sluice::mpm {

// Adds a warning for bodies (objects, and members of a union) of the material that lie less than a
// cell apart and hang together neither directly nor over others. Lists of points are left out.
void check_near_bodies(const SolidMaterial& material, const Level& level,
                       std::vector<Fault>& faults);

}  // namespace sluice::mpm
