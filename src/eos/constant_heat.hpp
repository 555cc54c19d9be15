// Constant specific heat: e = cv T (J/kg, K). The heat of an ideal gas far from vibration, of a
// solid well above its Debye temperature.
#pragma once

namespace sluice::eos {

struct ConstantHeat {
  double cv = 1.0;  // J/(kg K)

  double specific_heat(double /*T*/) const { return cv; }
  double energy(double T) const { return cv * T; }
  double temperature(double e) const { return e / cv; }
};

}  // namespace sluice::eos
