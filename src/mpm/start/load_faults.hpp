// What is wrong with loads where particles are: those that meet none.
#pragma once
#include <vector>

#include "framework/grid/level.hpp"
#include "mpm/deck/mpm_scene.hpp"
#include "mpm/start/seed.hpp"

namespace sluice::mpm {

// Adds a warning for each load that acts on no particle, and for each box that is no surface of the
// run. Looks at the particles in and around the pieces of the loads alone.
void check_loads(const MpmScene& scene, const Grid& grid, const Seeder& seeder,
                 std::vector<Fault>& faults);

}  // namespace sluice::mpm
