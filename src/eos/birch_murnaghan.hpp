// Birch-Murnaghan solid of third order, with the expansion branch of the Murnaghan law.
//
//   rho >= rho0: p = P0 + 3/(2K) (x^7/3 - x^5/3)(1 + 3/4 (n - 4)(x^2/3 - 1)),   x = rho/rho0
//   rho < rho0:  p = P0 x^(1/(K P0)), from 1e-6 P0 on falling with x
//   e = cv T + [9/2 f^2 (1 + (n - 4) f)/K + P0 (1 - 1/x)]/rho0,  f = (x^2/3 - 1)/2;  c^2 = dp/drho.
// Units: functions as in gruneisen_form.hpp; compressibility K 1/Pa (n is dK^-1/dp), P0 Pa.
// Reference: Birch, Phys. Rev. 71 (1947) 809. Limits: no thermal pressure, no tension; for n < 4
// pressure turns over at strong compression, where c^2 < 0 ends the admissible set. Admissible: rho
// > 0, T > 0, p > 0, c^2 > 0. Shock slope (n + 1)/4: exact for weak shocks.
#pragma once
#include "eos/murnaghan.hpp"

namespace sluice::eos {

struct BirchMurnaghanCurves {
  double n = 4.0;
  double K = 1.0;
  double rho0 = 1.0;
  double P0 = 101325.0;
  double specific_heat = 1.0;

  static constexpr std::string_view name = "BirchMurnaghan";
  static constexpr auto parameters() { return murnaghan_parameters<BirchMurnaghanCurves>(); }
  static constexpr bool depends_on_energy = false;
  static constexpr bool takes_any_heat = true;
  double offset(double rho) const {
    const double x = rho / rho0;
    if (x < 1.0) return expansion().pressure(x);
    const double c = std::cbrt(x), s = c * c, t = s - 1.0;
    return P0 + 1.5 / K * s * s * c * t * (1.0 + 0.75 * (n - 4.0) * t);
  }
  double offset_slope(double rho) const {
    const double x = rho / rho0;
    if (x < 1.0) return expansion().slope(x);
    const double c = std::cbrt(x), s = c * c, t = s - 1.0;
    return 0.5 / (K * rho0) * s *
           ((7.0 * s - 5.0) * (1.0 + 0.75 * (n - 4.0) * t) + 1.5 * (n - 4.0) * t * s);
  }
  double gruneisen(double /*rho*/) const { return 0.0; }
  double exponent(double /*rho*/) const { return 0.0; }
  double cold_energy(double rho) const {
    const double x = rho / rho0;
    if (x < 1.0) return expansion().energy(x);
    const double c = std::cbrt(x), f = 0.5 * (c * c - 1.0);
    return (4.5 / K * f * f * (1.0 + (n - 4.0) * f) + P0 * (1.0 - 1.0 / x)) / rho0;
  }

  double start_density() const { return rho0; }
  double shock_slope() const { return 0.25 * (n + 1.0); }
  double lowest_pressure() const { return 0.0; }
  double highest_density() const { return std::numeric_limits<double>::infinity(); }

 private:
  ExpansionBranch expansion() const { return {K, rho0, P0}; }
};
using BirchMurnaghan = GruneisenForm<BirchMurnaghanCurves>;

}  // namespace sluice::eos
