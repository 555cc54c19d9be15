// JWL isentrope (the C form): pressure of detonation products from density alone.
//
//   p = A exp(-R1 V) + B exp(-R2 V) + C V^-(1 + om),   V = rho0 / rho
//   e = cv T + A/(rho0 R1) exp(-R1 V) + B/(rho0 R2) exp(-R2 V) + C/(rho0 om) V^-om,
//   c^2 = dp/drho.
// Units: functions as in gruneisen_form.hpp; A, B, C Pa; rho0 kg/m^3; cv J/(kg K). Reference: Lee,
// Hornig and Kury, UCRL-50422 (1968); Souers, Anderson, Mercer, McGuire and Vitello, Propellants
// Explos. Pyrotech. 25 (2000) 54 (JWL++). Limits: no thermal pressure, so heating does not push.
// Admissible: rho > 0, T > 0, p > 0, c^2 > 0. Shock slope om/2 + 1, as in JWL.
#pragma once
#include <array>

#include "eos/gruneisen_form.hpp"
#include "eos/parameter.hpp"

namespace sluice::eos {

struct JwlcCurves {
  double A = 0.0, B = 0.0, C = 0.0;
  double R1 = 1.0, R2 = 1.0;
  double om = 0.3;
  double rho0 = 1.0;
  double specific_heat = 1.0;

  static constexpr std::string_view name = "JWLC";
  static constexpr auto parameters() {
    using P = Parameter<JwlcCurves>;
    return std::array{
        P{"A", "Pa", "pressure of the first exponential", &JwlcCurves::A, above(0)},
        P{"B", "Pa", "pressure of the second exponential", &JwlcCurves::B, any_number()},
        P{"R1", "", "first exponent", &JwlcCurves::R1, above(0)},
        P{"R2", "", "second exponent", &JwlcCurves::R2, above(0)},
        P{"om", "", "Grueneisen coefficient", &JwlcCurves::om, above(0)},
        P{"rho0", "kg/m^3", "density of the explosive", &JwlcCurves::rho0, above(0)},
        P{"C", "Pa", "pressure of the power of density", &JwlcCurves::C, any_number()},
        heat_of_material<JwlcCurves>()};
  }
  static constexpr bool depends_on_energy = false;
  static constexpr bool takes_any_heat = true;
  double offset(double rho) const {
    const double V = rho0 / rho;
    return A * std::exp(-R1 * V) + B * std::exp(-R2 * V) + C * std::pow(rho / rho0, 1.0 + om);
  }
  double offset_slope(double rho) const {
    const double x1 = R1 * rho0 / rho, x2 = R2 * rho0 / rho;
    return (A * x1 * std::exp(-x1) + B * x2 * std::exp(-x2) +
            C * (1.0 + om) * std::pow(rho / rho0, 1.0 + om)) /
           rho;
  }
  double gruneisen(double /*rho*/) const { return 0.0; }
  double exponent(double /*rho*/) const { return 0.0; }
  double cold_energy(double rho) const {
    const double V = rho0 / rho;
    return (A / R1 * std::exp(-R1 * V) + B / R2 * std::exp(-R2 * V) +
            C / om * std::pow(rho / rho0, om)) /
           rho0;
  }

  double start_density() const { return rho0; }
  double shock_slope() const { return 0.5 * om + 1.0; }
  double lowest_pressure() const { return 0.0; }
  double highest_density() const { return std::numeric_limits<double>::infinity(); }
};
using Jwlc = GruneisenForm<JwlcCurves>;

}  // namespace sluice::eos
