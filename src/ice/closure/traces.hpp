// What is too little of a material to be reckoned with, per volume of the cell.
#pragma once
#include <cmath>
#include <limits>

#include "ice/fluid/limiters.hpp"

namespace sluice::ice::mixture {

// Of less volume than this the numbers would lose their digits; no sum over cells knows of it.
constexpr double min_volume = 1e-100;
// Nor of a mass below this (the vapour of a cavity): rates by mass overflow.
constexpr double min_mass = 1e-200;
// The heat of less than this of a cell's mass is round-off of what the others exchange.
constexpr double next_to_nothing = 1e-9;
// But in a cavity that is larger than this vapour stays: nothing else would fill it.
constexpr double min_cavity = 1e-12;

// Of less than this share of a cell's mass energy over mass says nothing: in a cavity a gas holds
// at least the pressure 1e-12 pi (equilibrate.cpp), by T = p V/(M R) thousands of K of this share
// of a liquid, millions of a hundredth of it.
inline bool has_temperature(double M, double all) {
  constexpr double least = 1e-12;
  return M > least * all;
}

// The mass of a material, of which a cavity keeps the least; no sum over cells knows of that.
inline double vapour_kept(double M, double V) {
  const bool cavity = (int{M > 0.0} & int{V > min_cavity}) != 0;
  return larger(M, cavity ? min_mass : M);
}

// Is nothing left of a material after a step, to the round-off of what was there. Through one
// outlet a material leaves to the bit (remap_fluxes.cpp), through several only the sum of their
// fluxes is all of it.
inline bool is_gone(double M, double V, double M_before, double V_before) {
  constexpr double round_off = 16 * std::numeric_limits<double>::epsilon();
  const int light = int{std::fabs(M) <= round_off * M_before};
  const int thin = int{std::fabs(V) <= round_off * V_before} & int{V_before > 0.0};
  const int empty = int{std::fabs(M) < min_mass} | int{std::fabs(V) < min_volume};
  return (empty | light | thin) != 0;
}

// What is left of a material in a cell that a step drains has, of its volume and energy, the last
// digits of what was there, and would be at another temperature. Within those digits it keeps the
// density and the energy per mass of what was there (after the Lagrangian phase): volumes are
// closed and the energy is booked elsewhere.
constexpr double drained = 1e-3;  // of the mass that was there
struct Residue {
  double V, E;
};
inline Residue settled(double M, double V, double E, double M_before, double V_L, double E_L) {
  constexpr double last_digits = 1e-12;  // of what was there
  const double share = M / M_before;
  const auto within = [](double wanted, double found, double before) {
    const double room = last_digits * std::fabs(before);
    return smaller(larger(wanted, found - room), found + room);
  };
  const bool little = (int{share < drained} & int{M > 0.0}) != 0;
  return {little ? within(share * V_L, V, V_L) : V, little ? within(share * E_L, E, E_L) : E};
}

}  // namespace sluice::ice::mixture
