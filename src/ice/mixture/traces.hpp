// What is too little of a material to be reckoned with, per volume of the cell.
#pragma once
#include <cmath>
#include <limits>

namespace sluice::ice::mixture {

// Of less volume than this the numbers would lose their digits; no sum over cells knows of it.
constexpr double least_volume = 1e-100;
// Nor of a mass below this (the vapour of a cavity): rates by mass overflow.
constexpr double least_mass = 1e-200;
// The heat of less than this of a cell's mass is round-off of what the others exchange.
constexpr double next_to_nothing = 1e-9;
// But in a cavity that is larger than this vapour stays: nothing else would fill it.
constexpr double least_cavity = 1e-12;

// The mass of a material, of which a cavity keeps the least; no sum over cells knows of that.
inline double vapour_kept(double M, double V) {
  const bool thinned = (int{M > 0.0} & int{M < least_mass} & int{V > least_cavity}) != 0;
  return thinned ? least_mass : M;
}

// Is nothing left of a material after a step, to the round-off of what was there. Through one
// outlet a material leaves to the bit (remap_fluxes.cpp), through several only the sum of their
// fluxes is all of it.
inline bool is_gone(double M, double V, double M_before, double V_before) {
  constexpr double round_off = 16 * std::numeric_limits<double>::epsilon();
  const int light = int{std::fabs(M) <= round_off * M_before};
  const int thin = int{std::fabs(V) <= round_off * V_before} & int{V_before > 0.0};
  const int empty = int{std::fabs(M) < least_mass} | int{std::fabs(V) < least_volume};
  return (empty | light | thin) != 0;
}

}  // namespace sluice::ice::mixture
