// What is wrong with the places of particles: bodies that overlap, lie outside, or hold none.
#pragma once
#include <vector>

#include "framework/grid/level.hpp"
#include "mpm/deck/mpm_scene.hpp"

namespace sluice::mpm {

// Adds a warning for each object that gives no particle or loses some beyond the domain, and for
// each two of one material that fill the same places, and for loads that meet none; an error where
// the deck has no particle at all. Costs as much as visiting the surfaces of the pieces.
void check_seeds(const MpmScene& scene, const Grid& grid, std::vector<Fault>& faults);

}  // namespace sluice::mpm
