// Labels of what laws remember of a particle; several laws share some.
#pragma once
#include "framework/field/label.hpp"

namespace sluice::mpm {

inline Label particle_label(const char* name, const char* unit, const char* definition) {
  return declare_label({name, ValueType::real, Centring::particle, unit, definition});
}
inline Label plastic_strain_label() {
  return particle_label("p.plasticStrain", "", "equivalent plastic strain");
}
inline Label plastic_strain_rate_label() {
  return particle_label("p.plasticStrainRate", "1/s", "rate of the equivalent plastic strain");
}
inline Label strain_temperature_label() {
  return particle_label(
      "p.strainTemperature", "K",
      "temperature to which the thermal strain of a rate-form law has been taken");
}
inline Label yield_stress_label() {
  return particle_label("p.yieldStress", "Pa", "yield stress drawn for the particle");
}
inline Label localized_label() {
  return particle_label("p.localizedMPM", "",
                        "0 for a sound particle; 1, 2: failed in tension, in shear");
}
inline Label damage_label() {
  return particle_label("p.damage", "", "damage, 0 for a sound particle");
}

}  // namespace sluice::mpm
