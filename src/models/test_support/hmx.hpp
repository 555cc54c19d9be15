// The propellant of Ward, Son and Brewster: HMX.
#pragma once
#include "models/burn/steady_burn.hpp"

namespace sluice::models {

inline SteadyBurn hmx() {
  SteadyBurn law;
  law.solid_rate = 1.637e15;
  law.activation = 1.76e5;
  law.gas_rate = 1.6e-3;
  law.solid_heat = 4.0e5;
  law.gas_heat = 3.018e6;
  law.gas_conductivity = 0.07;
  law.conductivity = 0.2;
  law.specific_heat = 1.4e3;
  law.molar_mass = 3.42e-2;
  return law;
}
inline constexpr double hmx_density = 1840;

}  // namespace sluice::models
