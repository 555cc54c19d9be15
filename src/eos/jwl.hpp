// Jones-Wilkins-Lee products of detonation.
//
//   p = A (1 - om/(R1 V)) exp(-R1 V) + B (1 - om/(R2 V)) exp(-R2 V) + om rho e,   V = rho0 / rho
// or, above the cold curve,  p = A exp(-R1 V) + B exp(-R2 V) + om cv rho T,
//   e = cv T + A/(rho0 R1) exp(-R1 V) + B/(rho0 R2) exp(-R2 V).
// Units: functions as in gruneisen_form.hpp; A, B Pa; rho0 kg/m^3; cv J/(kg K). Reference: Lee,
// Hornig and Kury, Adiabatic expansion of high explosive detonation products, UCRL-50422 (1968).
// Limits: V below 0.3 and mixtures with air are outside the fits. With B < 0 (unreacted explosive)
// a part below rho0 can be unstable: the set c^2 > 0 leaves it out, and density(p, T) takes the
// root nearest to rho0. Admissible: rho > 0, T > 0, c^2 > 0, p above the lowest of the cold curve
// (0 if B >= 0). Shock slope om/2 + 1: strong shocks of the dilute products.
#pragma once
#include <array>

#include "eos/gruneisen_form.hpp"
#include "eos/parameter.hpp"

namespace sluice::eos {

struct JwlCurves {
  double A = 0.0, B = 0.0;
  double R1 = 1.0, R2 = 1.0;
  double om = 0.3;
  double rho0 = 1.0;
  double specific_heat = 1.0;

  static constexpr std::string_view name = "JWL";
  static constexpr auto parameters() {
    using P = Parameter<JwlCurves>;
    return std::array{
        P{"A", "Pa", "pressure of the first exponential", &JwlCurves::A, above(0)},
        P{"B", "Pa", "pressure of the second exponential", &JwlCurves::B, any_number()},
        P{"R1", "", "first exponent", &JwlCurves::R1, above(0)},
        P{"R2", "", "second exponent", &JwlCurves::R2, above(0)},
        P{"om", "", "Grueneisen coefficient", &JwlCurves::om, above(0)},
        P{"rho0", "kg/m^3", "density of the explosive", &JwlCurves::rho0, above(0)},
        heat_of_material<JwlCurves>()};
  }
  // What is wrong with the numbers together; empty where nothing is.
  std::string_view contradiction() const {
    return B < 0.0 && R1 == R2 ? "with B below 0, R1 and R2 must differ" : "";
  }
  static constexpr bool depends_on_energy = true;
  static constexpr bool takes_any_heat = true;
  double offset(double rho) const {
    const double x1 = R1 * rho0 / rho, x2 = R2 * rho0 / rho;
    return A * (1.0 - om / x1) * std::exp(-x1) + B * (1.0 - om / x2) * std::exp(-x2);
  }
  double offset_slope(double rho) const {
    const double x1 = R1 * rho0 / rho, x2 = R2 * rho0 / rho;
    return (A * (x1 - om - om / x1) * std::exp(-x1) + B * (x2 - om - om / x2) * std::exp(-x2)) /
           rho;
  }
  double gruneisen(double /*rho*/) const { return om; }
  double exponent(double /*rho*/) const { return 1.0; }
  double cold_energy(double rho) const {
    const double V = rho0 / rho;
    return (A / R1 * std::exp(-R1 * V) + B / R2 * std::exp(-R2 * V)) / rho0;
  }

  double start_density() const { return rho0; }
  double shock_slope() const { return 0.5 * om + 1.0; }
  double lowest_pressure() const {  // of the cold curve, which dips below zero where B does
    if (!(B < 0.0)) return 0.0;
    const double V = std::log(-A * R1 / (B * R2)) / (R1 - R2);
    return A * std::exp(-R1 * V) + B * std::exp(-R2 * V);
  }
  double highest_density() const { return std::numeric_limits<double>::infinity(); }
};
using Jwl = GruneisenForm<JwlCurves>;

}  // namespace sluice::eos
