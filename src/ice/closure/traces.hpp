// What is too little of a material to be reckoned with, per volume of the cell: M, V and E are the
// mass (kg/m^3), the volume fraction and the energy (J/m^3) of a material in it.
#pragma once
#include <cmath>
#include <limits>

#include "ice/fluid/limiters.hpp"

namespace sluice::ice::mixture {

// threshold: volume fraction below which a material is gone: its numbers would lose their digits,
//   and no sum over cells knows of it; unit: 1; test:
//   CompactSupport.NothingStaysBehindInObliqueFlow
constexpr double min_volume = 1e-100;
// threshold: density in the cell below which a material (the vapour of a cavity) is gone: rates
//   by mass overflow; unit: kg/m^3; test: none
constexpr double min_mass = 1e-200;
// threshold: share of a cell's mass below which the energy of a material is round-off of what the
//   others exchange; unit: 1; test: Equilibration.NextToNothingWithoutAStateTakesItsLeastPressure
constexpr double next_to_nothing = 1e-9;
// threshold: volume fraction of a cavity from which on its vapour stays: nothing else would fill
//   it; unit: 1; test: EquilibrationOfVapour.GoesWhereTheLiquidClosesItsCavity
constexpr double min_cavity = 1e-12;

// In a cavity a gas holds at least the pressure 1e-12 pi (equilibrate.cpp), by T = p V/(M R)
// thousands of K of this share of a liquid, millions of a hundredth of it.
inline bool has_temperature(double M, double all) {
  // threshold: share of a cell's mass up to which energy divided by mass gives no temperature;
  //   unit: 1; test: Cavitation.OpensAndCollapses
  constexpr double min_heated = 1e-12;
  return M > min_heated * all;
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
  // threshold: share of what was there up to which what is left is the round-off of fluxes; unit:
  //   1; test: none
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
// threshold: share of its mass before a step below which a material has drained from a cell;
//   unit: 1; test: AnyPair.StaysInEquilibriumOnItsWay
constexpr double drained = 1e-3;
struct Residue {
  double V, E;
};
inline Residue drained_residue(double M, double V, double E, double M_before, double V_L,
                               double E_L) {
  // threshold: share of its volume and energy before that what is left of a drained material may
  //   be moved by; unit: 1; test: AnyPair.StaysInEquilibriumOnItsWay
  constexpr double last_digits = 1e-12;
  const double share = M / M_before;
  const auto within = [](double wanted, double found, double before) {
    const double room = last_digits * std::fabs(before);
    return smaller(larger(wanted, found - room), found + room);
  };
  const bool little = (int{share < drained} & int{M > 0.0}) != 0;
  return {little ? within(share * V_L, V, V_L) : V, little ? within(share * E_L, E, E_L) : E};
}

}  // namespace sluice::ice::mixture
