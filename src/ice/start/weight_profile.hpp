// The pressure that carries several materials at the start: one balance from the lowest cell up,
//
//   p_{j+1} - p_j = g dx (rho_j + rho_{j+1})/2,   p_0 = reference_pressure,
//
// a function of the height alone, so that nothing is pushed aside. rho_j is the density of all
// materials together where the marked one (<isSurroundingMatl>) has most of a cell at that height,
// and of what is there where it has none: layers rest on each other, and a body of another density
// sinks or rises in what surrounds it.
#pragma once
#include <vector>

#include "framework/grid/level.hpp"
#include "framework/scene/scene.hpp"
#include "ice/deck/ice_scene.hpp"

namespace sluice::ice {

struct WeightProfile {
  int direction = -1;            // of gravity; none: there is no balance
  int first = 0;                 // index of the lowest cell
  std::vector<double> pressure;  // of each cell of the level along it, Pa
};

// Where gravity acts along one direction that does not repeat; throws InputError as fill_materials.
WeightProfile weight_profile(const IceScene& scene, const PhysicalConstants& constants,
                             const Level& coarsest, const Level& level);

}  // namespace sluice::ice
