// Specific heat of a gas from the NASA polynomials of fourth degree, two ranges of temperature.
//
//   cp/R = a1 + a2 T + a3 T^2 + a4 T^3 + a5 T^4,   cv = cp - R,   e = integral of cv from 0 K.
// Outside [T_min, T_max] cv keeps its value at the end of the range, so that e rises for every T
// and T(e) exists; the small jump of cv at T_mid leaves e continuous. Formation energies are left
// out: heat of reaction is a source of its own. Units: R and cv J/(kg K), T K, e J/kg, a_k K^(1-k).
// Reference: McBride, Gordon and
// Reno, NASA TM-4513 (1993).
#pragma once
#include <algorithm>
#include <array>

#include "eos/bracketed_root.hpp"

namespace sluice::eos {

struct Nasa7Heat {
  using Coefficients = std::array<double, 5>;
  double gas_constant = 287.0;
  Coefficients low = {3.5, 0, 0, 0, 0};
  Coefficients high = {3.5, 0, 0, 0, 0};
  double T_min = 200.0, T_mid = 1000.0, T_max = 6000.0;

  double specific_heat(double T) const {
    const double t = std::min(std::max(T, T_min), T_max);
    return gas_constant * (polynomial(t < T_mid ? low : high, t) - 1.0);
  }
  double energy(double T) const {
    const double cold = std::min(T, T_min), hot = std::max(T, T_max) - T_max;
    const double t_low = std::min(std::max(T, T_min), T_mid);
    const double t_high = std::min(std::max(T, T_mid), T_max);
    return specific_heat(T_min) * cold +
           gas_constant * (integral(low, t_low) - integral(low, T_min)) +
           gas_constant * (integral(high, t_high) - integral(high, T_mid)) +
           specific_heat(T_max) * hot;
  }
  // Newton: e is all but convex, so that a few steps do, the last one with a square that is
  // round-off; where they do not, the bracket that cv > 3/2 R gives.
  double temperature(double e) const {
    if (!(e > energy(T_min))) return e / specific_heat(T_min);
    double T = 0.4 * e / gas_constant;
    for (int step = 0; step < 8; ++step) {
      const double next = std::max(T - (energy(T) - e) / specific_heat(T), T_min);
      if (std::abs(next - T) <= 1e-9 * T) return next;
      T = next;
    }
    const auto excess = [&](double t) { return ValueAndSlope{energy(t) - e, specific_heat(t)}; };
    return bracketed_root(excess, T_min, T_min + e / gas_constant, T);
  }
  double ratio(double T) const { return 1.0 + gas_constant / specific_heat(T); }  // gamma

 private:
  static double polynomial(const Coefficients& a, double T) {
    return (((a[4] * T + a[3]) * T + a[2]) * T + a[1]) * T + a[0];
  }
  static double integral(const Coefficients& a, double T) {  // of cp/R - 1
    return ((((a[4] / 5 * T + a[3] / 4) * T + a[2] / 3) * T + a[1] / 2) * T + a[0] - 1.0) * T;
  }
};

}  // namespace sluice::eos
