// Ratio of specific heats of a state of any law.
//
//   cp/cv = c^2/c_T^2,   c_T^2 = c^2 - T (dp/dT)^2/(rho^2 cv) at constant volume,
//   dp/dT = cv dp/de,  so that  cp/cv = c^2/(c^2 - T g^2 cv),  g = (dp/de)/rho.
// Reference: Callen, Thermodynamics (1985), chapter 7.
#pragma once

namespace sluice::eos {

// rho: kg/m^3, rho_e: internal energy per volume, J/m^3, T: K, cv: J/(kg K).
template <class Law>
double ratio_of_heats(const Law& law, double rho, double rho_e, double T, double cv) {
  const double c2 = law.sound_speed_squared(rho, rho_e), g = law.dp_de(rho, rho_e) / rho;
  return c2 / (c2 - T * g * g * cv);
}

}  // namespace sluice::eos
