// The flow that a skew deck ends with, in the axes of its case.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "properties/skew_deck.hpp"

namespace sluice::properties {

// Density, temperature, velocity and, with several materials, share of every cell of every level,
// coarse to fine, of one material after the other; nothing where a level has no cells.
struct Flow {
  std::vector<double> density, temperature, share;
  std::vector<Vec3> velocity;
  std::vector<std::int64_t> cells;  // by level
};

// Runs the deck some steps. A failure or an event on the way fails the test.
Flow flow_of(const SkewCase& c, const Orientation& o);

// Where they differ by more than `allowed` of the largest value, temperature and velocity times the
// share of their material; "" when nowhere.
std::string difference(const Flow& a, const Flow& b, double allowed);

}  // namespace sluice::properties
