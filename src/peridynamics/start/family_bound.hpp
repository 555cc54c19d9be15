// How many neighbours a point may have at most, before any point is made.
//
// Points of one lattice have those of the lattice around a point; of another lattice a ball holds
// no more than one about any place, widened by half the diagonal of a part. Points of lists are
// counted.
#pragma once
#include <cstdint>
#include <vector>

#include "framework/grid/level.hpp"
#include "peridynamics/deck/peri_scene.hpp"

namespace sluice::peridynamics {

struct FamilyBound {
  int largest = 0;          // of any point
  double typical = 0;       // of points inside bodies, the mean over objects
  std::int64_t points = 0;  // in all
};
FamilyBound bound_families(const PeriScene& scene, const Level& level);

// A fault for each horizon that is too short for the points of its material, or too long for the
// domain.
void check_horizons(const Level& level, const PeriScene& scene, std::vector<Fault>& faults);

// Spacing of an object's points, (V/h)^(1/d); the largest of a list.
double spacing_of(const PeriScene& scene, const Level& level, const mpm::SeedObject& object);

}  // namespace sluice::peridynamics
