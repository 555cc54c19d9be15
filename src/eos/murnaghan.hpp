// Murnaghan solid or liquid, with a power law in expansion that never reaches zero pressure.
//
//   rho >= rho0: p = P0 + ((rho/rho0)^n - 1)/(n K);   rho < rho0: p = P0 (rho/rho0)^(1/(K P0)),
//   below rho_v, where that is 1e-6 P0: p = 1e-6 P0 rho/rho_v
//   e = cv T + integral of p / rho^2 from rho0,   c^2 = dp/drho.
// Units: functions as in gruneisen_form.hpp; compressibility K 1/Pa, P0 Pa. Reference: Murnaghan,
// Proc. Natl Acad. Sci. 30 (1944) 244. Limits: no thermal pressure; no tension. Admissible: rho >
// 0, T > 0, p > 0. Shock slope (n + 1)/4: exact for weak shocks, c = dp/du grows with (n + 1)/2.
#pragma once
#include <array>

#include "eos/gruneisen_form.hpp"
#include "eos/parameter.hpp"

namespace sluice::eos {

// (x^a - 1)/a, also at a = 0; no units.
inline double power_integral(double x, double a) {
  const double l = std::log(x);
  return a == 0.0 ? l : std::expm1(a * l) / a;
}

// The branch below rho0 that the Murnaghan laws share: p and c^2 continuous at rho0. A solid falls
// to next to no pressure within a hundredth of expansion: from min_share of P0 on, at x_v, it is
// dust, whose pressure falls with density alone, so that torn matter keeps a sound speed.
// x = rho/rho0; pressure in Pa, slope dp/drho in m^2/s^2, energy in J/kg.
struct ExpansionBranch {
  static constexpr double min_share = 1e-6;
  double K = 1.0, rho0 = 1.0, P0 = 1.0;  // 1/Pa, kg/m^3, Pa
  double pressure(double x) const {
    const double x_v = vacuum_compression();
    return x < x_v ? min_share * P0 * (x / x_v) : P0 * std::pow(x, 1.0 / (K * P0));
  }
  double slope(double x) const {
    const double x_v = vacuum_compression();
    return x < x_v ? min_share * P0 / (x_v * rho0) : std::pow(x, 1.0 / (K * P0) - 1.0) / (K * rho0);
  }
  double energy(double x) const {
    const double x_v = vacuum_compression(),
                 solid = power_integral(std::fmax(x, x_v), 1.0 / (K * P0) - 1.0);
    return P0 / rho0 * (x < x_v ? solid + min_share / x_v * std::log(x / x_v) : solid);
  }
  double density(double p) const {
    const double share = p / P0;
    return rho0 * (share < min_share ? vacuum_compression() * (share / min_share)
                                     : std::pow(share, K * P0));
  }

 private:
  double vacuum_compression() const { return std::pow(min_share, K * P0); }  // x_v
};

// The numbers of both laws.
template <class Curves>
constexpr auto murnaghan_parameters() {
  using P = Parameter<Curves>;
  return std::array{P{"n", "", "derivative of the bulk modulus by pressure", &Curves::n, above(0)},
                    P{"K", "1/Pa", "compressibility (not the bulk modulus)", &Curves::K, above(0)},
                    P{"rho0", "kg/m^3", "density of reference", &Curves::rho0, above(0)},
                    P{"P0", "Pa", "pressure at that density", &Curves::P0, above(0)},
                    heat_of_material<Curves>()};
}

struct MurnaghanCurves {
  double n = 7.0;
  double K = 1.0;
  double rho0 = 1.0;
  double P0 = 101325.0;
  double specific_heat = 1.0;

  static constexpr std::string_view name = "Murnaghan";
  static constexpr auto parameters() { return murnaghan_parameters<MurnaghanCurves>(); }
  static constexpr bool depends_on_energy = false;
  static constexpr bool takes_any_heat = true;
  double offset(double rho) const {
    const double x = rho / rho0;
    return x >= 1.0 ? P0 + (std::pow(x, n) - 1.0) / (n * K) : expansion().pressure(x);
  }
  double offset_slope(double rho) const {
    const double x = rho / rho0;
    return x >= 1.0 ? std::pow(x, n - 1.0) / (K * rho0) : expansion().slope(x);
  }
  double gruneisen(double /*rho*/) const { return 0.0; }
  double exponent(double /*rho*/) const { return 0.0; }
  double cold_energy(double rho) const {
    const double x = rho / rho0;
    if (x < 1.0) return expansion().energy(x);
    return ((P0 - 1.0 / (n * K)) * (1.0 - 1.0 / x) + power_integral(x, n - 1.0) / (n * K)) / rho0;
  }
  double closed_density(double p, double /*thermal*/) const {
    return p >= P0 ? rho0 * std::pow(1.0 + n * K * (p - P0), 1.0 / n) : expansion().density(p);
  }

  double shock_slope() const { return 0.25 * (n + 1.0); }
  double lowest_pressure() const { return 0.0; }
  double highest_density() const { return std::numeric_limits<double>::infinity(); }

 private:
  ExpansionBranch expansion() const { return {K, rho0, P0}; }
};
using Murnaghan = GruneisenForm<MurnaghanCurves>;

}  // namespace sluice::eos
