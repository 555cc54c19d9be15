// Hard-sphere gas (Noble-Abel): an ideal gas whose molecules have a volume of their own.
//
//   p = (gamma - 1) rho e / (1 - b rho),   e = cv T,   c^2 = gamma p / (rho (1 - b rho)).
// Units: functions as in gruneisen_form.hpp; covolume b m^3/kg. Reference: Johnston, Defence
// Science and Technology note DSTO-TN-0670 (2005). Limits: rho < 1/b; no attraction. Admissible: 0
// < rho < 1/b, e > 0. Shock slope (gamma + 1)/2, that of the dilute gas.
#pragma once
#include <array>

#include "eos/gruneisen_form.hpp"
#include "eos/parameter.hpp"

namespace sluice::eos {

struct HardSphereCurves {
  double gamma = 1.4;
  double b = 0.0;
  double specific_heat = 1.0;

  static constexpr std::string_view name = "hard_sphere_gas";
  static constexpr auto parameters() {
    using P = Parameter<HardSphereCurves>;
    return std::array{gamma_of_material<HardSphereCurves>(),
                      P{"b", "m^3/kg", "covolume", &HardSphereCurves::b, at_least(0)},
                      heat_of_material<HardSphereCurves>()};
  }
  double constant_heat_capacity_ratio() const { return gamma; }
  static constexpr bool depends_on_energy = true;
  static constexpr bool takes_any_heat = true;
  double offset(double /*rho*/) const { return 0.0; }
  double offset_slope(double /*rho*/) const { return 0.0; }
  double gruneisen(double rho) const { return (gamma - 1.0) / (1.0 - b * rho); }
  double exponent(double rho) const { return 1.0 / (1.0 - b * rho); }
  double cold_energy(double /*rho*/) const { return 0.0; }
  double closed_density(double p, double thermal) const {
    return p / ((gamma - 1.0) * thermal + b * p);
  }

  double shock_slope() const { return 0.5 * (gamma + 1.0); }
  double lowest_pressure() const { return 0.0; }
  double highest_density() const { return 1.0 / b; }
};
using HardSphereGas = GruneisenForm<HardSphereCurves>;

}  // namespace sluice::eos
