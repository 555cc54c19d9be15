// Twu-Sim-Tassone cubic equation of state: van der Waals repulsion with a two-parameter attraction.
//
//   p = (Gamma - 1) cv T / (v - b) - a / ((v + u b)(v + w b)),   v = 1/rho
//   e = cv T - a ln((v + u b)/(v + w b)) / (b (u - w)) = cv T - a * integral of drho/(..)(..)
//   c^2 = p_c' + (Gamma - 1) Gamma cv T / (1 - b rho)^2,  p_c the attraction's part of p.
// Units: functions as in gruneisen_form.hpp; a Pa m^6/kg^2, b m^3/kg; u, w, Gamma are numbers (u =
// -.5, w = 3 in the reference). Reference: Twu, Sim and Tassone, Fluid Phase Equilibria 194 (2002)
// 385. Limits: rho < 1/b, constant a; between the spinodals c^2 < 0. Admissible: 0 < rho < 1/b, T >
// 0, c^2 > 0, p > a lower bound of the attraction. density(p, T): the gas (largest v) where there
// are several. Shock slope (Gamma + 1)/2, that of the dilute gas.
#pragma once
#include <array>

#include "eos/gruneisen_form.hpp"
#include "eos/parameter.hpp"

namespace sluice::eos {

struct TstCurves {
  double a = 0.0, b = 0.0;
  double u = -0.5, w = 3.0;
  double Gamma = 1.4;
  double specific_heat = 1.0;

  static constexpr std::string_view name = "TST";
  static constexpr auto parameters() {
    using P = Parameter<TstCurves>;
    return std::array{P{"a", "Pa m^6/kg^2", "attraction", &TstCurves::a, any_number()},
                      P{"b", "m^3/kg", "covolume", &TstCurves::b, above(0)},
                      P{"u", "", "first number of the attraction", &TstCurves::u, above(-1)},
                      P{"w", "", "second number of the attraction", &TstCurves::w, above(-1)},
                      P{"Gamma", "", "ratio of specific heats", &TstCurves::Gamma, above(1)},
                      heat_of_material<TstCurves>()};
  }
  static constexpr bool depends_on_energy = true;
  static constexpr bool takes_any_heat = true;
  double offset(double rho) const {
    return cold_pressure(rho) - gruneisen(rho) * rho * cold_energy(rho);
  }
  double offset_slope(double rho) const {
    const double pu = 1.0 + u * b * rho, pw = 1.0 + w * b * rho;
    const double cold_slope = -a * rho * (pu + pw) / (pu * pu * pw * pw);
    const double G = gruneisen(rho);
    return cold_slope - exponent(rho) * G * cold_energy(rho) - G * cold_pressure(rho) / rho;
  }
  double gruneisen(double rho) const { return (Gamma - 1.0) / (1.0 - b * rho); }
  double exponent(double rho) const { return 1.0 / (1.0 - b * rho); }
  double cold_pressure(double rho) const {
    return -a * rho * rho / ((1.0 + u * b * rho) * (1.0 + w * b * rho));
  }
  double cold_energy(double rho) const {
    const double d = (u - w) * b, tail = rho / (1.0 + w * b * rho);
    return -a * (d == 0.0 ? tail : std::log1p(d * tail) / d);
  }
  // Largest root of the cubic in v by Newton from above all roots, where it falls steadily.
  double closed_density(double p, double thermal) const {
    if (!(p > 0.0)) return no_density;
    const double g = (Gamma - 1.0) * thermal / p, A = a / p, sum = (u + w) * b, uw = u * w * b * b;
    const double c2 = sum - b - g, c1 = uw - sum * (b + g) + A, c0 = -uw * (b + g) - A * b;
    double v = 2.0 * std::max({std::abs(c2), std::sqrt(std::abs(c1)), std::cbrt(std::abs(c0))});
    for (int step = 0; step < 100; ++step) {
      const double value = ((v + c2) * v + c1) * v + c0, slope = (3.0 * v + 2.0 * c2) * v + c1;
      const double next = v - value / slope;
      if (!(next < v)) break;
      v = next;
    }
    return 1.0 / v;
  }

  double shock_slope() const { return 0.5 * (Gamma + 1.0); }
  double lowest_pressure() const { return std::min(cold_pressure(1.0 / b), 0.0); }
  double highest_density() const { return 1.0 / b; }
};
using TstGas = GruneisenForm<TstCurves>;

}  // namespace sluice::eos
