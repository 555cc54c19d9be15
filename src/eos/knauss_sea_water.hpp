// Sea water after Knauss: density linear in temperature, salinity and pressure.
//
//   rho = rho0 + a (T - T0) + b (S - S0) + K (p - P0)
//   e = cv T + [P0 + (a T0 - r)/K](1/r - 1/rho) + ln(rho/r)/K,  r = rho0 + b (S - S0)  (from the
//   equality of mixed derivatives),   c^2 = 1/K + T (a/K)^2 / (cv rho^2).
// Units: functions as in gruneisen_form.hpp; a kg/(m^3 K), b kg/m^3 per unit of salinity S (parts
// per thousand), K s^2/m^2. Reference: Knauss, Introduction to Physical Oceanography (1997),
// chapter 1. Limits: near T0, S0 and the surface; S is one number for the whole material.
// Admissible: rho > 0, T > 0 and p above that of vanishing density at 0 K. Shock slope 1/2
// (pressure linear in density).
#pragma once
#include <array>

#include "eos/gruneisen_form.hpp"
#include "eos/parameter.hpp"

namespace sluice::eos {

struct KnaussCurves {
  double a = -0.15, b = 0.0;
  double K = 4.5e-7;
  double T0 = 283.15, P0 = 101325.0;
  double S = 35.0, S0 = 35.0;
  double rho0 = 1027.0;
  double specific_heat = 3990.0;

  static constexpr std::string_view name = "KnaussSeaWater";
  static constexpr auto parameters() {
    using P = Parameter<KnaussCurves>;
    return std::array{P{"a", "kg/(m^3 K)", "density for each kelvin, not 0", &KnaussCurves::a,
                        any_number(), Given::in_law_or_default},
                      P{"b", "kg/m^3", "density for each unit of salinity", &KnaussCurves::b,
                        any_number(), Given::in_law_or_default},
                      P{"K", "s^2/m^2", "density for each pascal", &KnaussCurves::K, above(0),
                        Given::in_law_or_default},
                      P{"T0", "K", "temperature of reference", &KnaussCurves::T0, above(0),
                        Given::in_law_or_default},
                      P{"P0", "Pa", "pressure of reference", &KnaussCurves::P0, any_number(),
                        Given::in_law_or_default},
                      P{"S", "", "salinity, parts per thousand", &KnaussCurves::S, at_least(0),
                        Given::in_law_or_default},
                      P{"S0", "", "salinity of reference", &KnaussCurves::S0, at_least(0),
                        Given::in_law_or_default},
                      P{"rho0", "kg/m^3", "density of reference", &KnaussCurves::rho0, above(0),
                        Given::in_law_or_default},
                      heat_of_material<KnaussCurves>()};
  }
  std::string_view contradiction() const {
    return a == 0.0 ? "<a> must not be 0, or no pressure would follow from the energy" : "";
  }
  // Water that contracts when heated.
  bool pressure_falls_with_energy() const { return a > 0.0; }
  static constexpr bool depends_on_energy = true;
  static constexpr bool takes_any_heat = false;
  double offset(double rho) const {
    return cold_pressure(rho) + a / (K * specific_heat) * cold_energy(rho);
  }
  double offset_slope(double rho) const {
    return 1.0 / K + a / (K * specific_heat) * cold_pressure(rho) / (rho * rho);
  }
  double gruneisen(double rho) const { return -a / (K * specific_heat * rho); }
  double exponent(double /*rho*/) const { return 0.0; }
  double cold_energy(double rho) const {
    const double r = salted();
    return (P0 + (a * T0 - r) / K) * (1.0 / r - 1.0 / rho) + std::log(rho / r) / K;
  }
  double closed_density(double p, double thermal) const {
    const double rho = salted() + a * (thermal / specific_heat - T0) + K * (p - P0);
    return rho > 0.0 ? rho : no_density;
  }

  double shock_slope() const { return 0.5; }
  double lowest_pressure() const { return std::min(cold_pressure(0.0), 0.0); }
  double highest_density() const { return std::numeric_limits<double>::infinity(); }

 private:
  double salted() const { return rho0 + b * (S - S0); }
  double cold_pressure(double rho) const { return P0 + (rho - salted() + a * T0) / K; }
};
using KnaussSeaWater = GruneisenForm<KnaussCurves>;

}  // namespace sluice::eos
