// Linear equation of state in density and temperature (type Gruneisen of the decks).
//
//   p = P0 + A (rho/rho0 - 1) + B (T - T0),   alpha = B / (p_c + A),  p_c the pressure at 0 K
//   e = cv T + [(P0 - A - B T0)(1 - 1/x) + A ln x]/rho0,  x = rho/rho0,
//   from the equality of mixed derivatives;   c^2 = A/rho0 + T B^2 / (cv rho^2).
// Units: functions as in gruneisen_form.hpp; A Pa, B Pa/K, rho0 kg/m^3. Reference: the linear form
// of Mie and Grueneisen; a straight line through one state. Limits: small changes about (rho0, T0).
// Admissible: rho > 0, T > 0, p > P0 - A - B T0 (the pressure of vanishing density at 0 K).
// Shock slope 1/2: c rho is uniform in a medium whose pressure is linear in density.
#pragma once
#include <array>

#include "eos/gruneisen_form.hpp"
#include "eos/parameter.hpp"

namespace sluice::eos {

struct LinearGruneisenCurves {
  double A = 1.0, B = 0.0;
  double rho0 = 1.0;
  double T0 = 300.0;
  double P0 = 101325.0;
  double specific_heat = 1.0;

  static constexpr std::string_view name = "Gruneisen";
  static constexpr auto parameters() {
    using P = Parameter<LinearGruneisenCurves>;
    return std::array{
        P{"A", "Pa", "pressure for each share of density", &LinearGruneisenCurves::A, above(0)},
        P{"B", "Pa/K", "pressure for each kelvin", &LinearGruneisenCurves::B, above(0)},
        P{"rho0", "kg/m^3", "density of reference", &LinearGruneisenCurves::rho0, above(0)},
        P{"T0", "K", "temperature of reference", &LinearGruneisenCurves::T0, above(0)},
        P{"P0", "Pa", "pressure of reference", &LinearGruneisenCurves::P0, any_number()},
        heat_of_material<LinearGruneisenCurves>()};
  }
  static constexpr bool depends_on_energy = true;
  static constexpr bool takes_any_heat = false;
  double offset(double rho) const {
    return P0 + A * (rho / rho0 - 1.0) - B * (T0 + cold_energy(rho) / specific_heat);
  }
  double offset_slope(double rho) const {
    const double cold_pressure = P0 + A * (rho / rho0 - 1.0) - B * T0;
    return A / rho0 - B / specific_heat * cold_pressure / (rho * rho);
  }
  double gruneisen(double rho) const { return B / (specific_heat * rho); }
  double exponent(double /*rho*/) const { return 0.0; }
  double cold_energy(double rho) const {
    const double x = rho / rho0;
    return ((P0 - A - B * T0) * (1.0 - 1.0 / x) + A * std::log(x)) / rho0;
  }
  double closed_density(double p, double thermal) const {
    const double rho = rho0 * (1.0 + (p - P0 - B * (thermal / specific_heat - T0)) / A);
    return rho > 0.0 ? rho : no_density;
  }

  double shock_slope() const { return 0.5; }
  double lowest_pressure() const { return P0 - A - B * T0; }
  double highest_density() const { return std::numeric_limits<double>::infinity(); }
};
using LinearGruneisen = GruneisenForm<LinearGruneisenCurves>;

}  // namespace sluice::eos
