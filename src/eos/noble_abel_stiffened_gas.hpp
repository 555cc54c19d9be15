// Noble-Abel stiffened gas: a liquid or dense gas with attraction, repulsion and thermal motion.
//
//   p = (gamma - 1) rho (e - q)/(1 - b rho) - gamma pinf,   e = cv T + pinf (1/rho - b) + q,
//   c^2 = gamma (p + pinf)/(rho (1 - b rho)),   p + pinf = (gamma - 1) cv T/(1/rho - b).
// Units: functions as in gruneisen_form.hpp; covolume b m^3/kg, pinf Pa, q J/kg. With b = 0 the
// stiffened gas, with pinf = 0 the hard-sphere gas. Reference: Le Metayer and Saurel, Phys. Fluids
// 28 (2016) 046102. Limits: rho < 1/b; constants fitted over a range of temperatures. Admissible: 0
// < rho < 1/b, p > -pinf (which is T > 0). Shock slope (gamma + 1)/2, that of the dilute gas.
#pragma once
#include <array>

#include "eos/gruneisen_form.hpp"
#include "eos/parameter.hpp"

namespace sluice::eos {

struct NobleAbelStiffenedCurves {
  double gamma = 1.4;
  double pinf = 0.0, b = 0.0, q = 0.0;
  double specific_heat = 1.0;

  static constexpr std::string_view name = "NobleAbelStiffenedGas";
  static constexpr auto parameters() {
    using Curves = NobleAbelStiffenedCurves;
    using P = Parameter<Curves>;
    return std::array{
        gamma_of_material<Curves>(),
        P{"pinf", "Pa", "constant extra pressure", &Curves::pinf, at_least(0)},
        P{"b", "m^3/kg", "covolume", &Curves::b, at_least(0)},
        P{"q", "J/kg", "energy at 0 K", &Curves::q, any_number(), Given::in_law_or_default},
        heat_of_material<Curves>()};
  }
  double constant_heat_capacity_ratio() const { return gamma; }
  static constexpr bool depends_on_energy = true;
  static constexpr bool takes_any_heat = true;
  double offset(double rho) const { return -gamma * pinf - gruneisen(rho) * q * rho; }
  double offset_slope(double rho) const { return -exponent(rho) * gruneisen(rho) * q; }
  double gruneisen(double rho) const { return (gamma - 1.0) / (1.0 - b * rho); }
  double exponent(double rho) const { return 1.0 / (1.0 - b * rho); }
  double cold_energy(double rho) const { return pinf * (1.0 / rho - b) + q; }
  double closed_density(double p, double thermal) const {
    const double P = p + pinf;
    return P / ((gamma - 1.0) * thermal + b * P);
  }

  double shock_slope() const { return 0.5 * (gamma + 1.0); }
  double lowest_pressure() const { return -pinf; }
  double highest_density() const { return 1.0 / b; }
};
using NobleAbelStiffenedGas = GruneisenForm<NobleAbelStiffenedCurves>;

}  // namespace sluice::eos
