// Stiffened gas: a liquid or solid as an ideal gas under a constant extra pressure.
//
//   p = (gamma - 1) rho (e - q) - gamma pinf,   e = cv T + pinf / rho + q,
//   c^2 = gamma (p + pinf) / rho.
// Units: functions as in gruneisen_form.hpp; pinf Pa, q and e J/kg, cv J/(kg K). Reference: Le
// Metayer, Massoni and Saurel, Int. J. Thermal Sci. 43 (2004) 265. Limits: constant Grueneisen
// coefficient; the density at 0 K is unbounded, so p(rho, T) is right near one state only.
// Admissible: rho > 0, p > -pinf (which is T > 0). Shock slope (gamma + 1)/2: exact for strong
// shocks.
#pragma once
#include <array>

#include "eos/gruneisen_form.hpp"
#include "eos/parameter.hpp"

namespace sluice::eos {

struct StiffenedCurves {
  double gamma = 4.4;
  double pinf = 0.0;
  double q = 0.0;
  double specific_heat = 1.0;

  static constexpr std::string_view name = "StiffenedGas";
  static constexpr auto parameters() {
    using P = Parameter<StiffenedCurves>;
    return std::array{
        gamma_of_material<StiffenedCurves>(),
        P{"pinf", "Pa", "constant extra pressure", &StiffenedCurves::pinf, at_least(0)},
        P{"q", "J/kg", "energy at 0 K", &StiffenedCurves::q, any_number(),
          Given::in_law_or_default},
        heat_of_material<StiffenedCurves>()};
  }
  double constant_heat_capacity_ratio() const { return gamma; }
  static constexpr bool depends_on_energy = true;
  static constexpr bool takes_any_heat = true;
  double offset(double rho) const { return -gamma * pinf - (gamma - 1.0) * q * rho; }
  double offset_slope(double /*rho*/) const { return -(gamma - 1.0) * q; }
  double gruneisen(double /*rho*/) const { return gamma - 1.0; }
  double exponent(double /*rho*/) const { return 1.0; }
  double cold_energy(double rho) const { return pinf / rho + q; }
  double closed_density(double p, double thermal) const {
    return (p + pinf) / ((gamma - 1.0) * thermal);
  }

  double shock_slope() const { return 0.5 * (gamma + 1.0); }
  double lowest_pressure() const { return -pinf; }
  double highest_density() const { return std::numeric_limits<double>::infinity(); }
};
using StiffenedGas = GruneisenForm<StiffenedCurves>;

}  // namespace sluice::eos
