// Sides of shock tubes of tests.
#pragma once
#include "exact/riemann/material_riemann.hpp"

namespace sluice::exact {

inline MaterialSide gas(double gamma, double density, double velocity, double pressure) {
  const eos::IdealGas law{.gamma = gamma, .specific_heat = 717.5};
  return {law, state_of_pressure(law, density, velocity, pressure)};
}
inline MaterialSide water(double density, double velocity, double pressure) {
  const eos::StiffenedGas law{{.gamma = 4.4, .pinf = 6e8, .q = 0, .specific_heat = 1816}};
  return {law, state_of_pressure(law, density, velocity, pressure)};
}

}  // namespace sluice::exact
