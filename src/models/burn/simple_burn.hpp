// Model "Simple_Burn": the surface of a solid becomes gas at a rate that follows the pressure.
//
//   m' = A (p/p_ref)^0.778 per area, where p is above its threshold and something hot is near
// The exponent is that of HMX. Heat: <Enthalpy> per mass, beside what the solid carries.
#pragma once
#include <cmath>
#include <memory>

#include "models/burn/burn_law.hpp"
#include "models/deck/reactant.hpp"

namespace sluice {
struct TagSpec;
}

namespace sluice::models {

struct SimpleBurn {
  static constexpr double exponent = 0.778;

  double threshold_temperature = 0, threshold_pressure = 0;  // K, Pa
  double heat = 0;                                           // J/kg
  double coefficient = 0;                                    // kg/(m^2 s)
  double reference_pressure = 1;                             // Pa

  bool burns(double pressure, double hottest) const {
    return pressure > threshold_pressure && hottest > threshold_temperature;
  }
  // Mass per area and time, kg/(m^2 s).
  double flux(double pressure) const {
    return coefficient * std::pow(pressure / reference_pressure, exponent);
  }
};

TagSpec simple_burn_tag();
std::shared_ptr<const BurnLaw> read_simple_burn(const DeckNode& parameters,
                                                const MaterialNames& names);

}  // namespace sluice::models
