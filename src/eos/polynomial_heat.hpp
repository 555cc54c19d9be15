// Specific heat as a polynomial in 1/T, the form of fits to detonation products.
//
//   cv = (a_0 + a_1 T + ... + a_n T^n) / T^n,   e = integral of cv from 0 K.
// Outside [T_min, T_max] cv keeps its value at the end of the range, so that e(0) = 0 and T(e)
// exists. Units: cv J/(kg K), T K, e J/kg. Limits: n <= 11; T_min > 0 unless n = 0.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "eos/bracketed_root.hpp"

namespace sluice::eos {

struct PolynomialHeat {
  static constexpr int max_order = 11;
  std::array<double, max_order + 1> inverse{};  // cv = sum of inverse[k] / T^k: J K^(k-1)/kg
  int order = 0;
  double T_min = 1.0, T_max = 1e6;

  double specific_heat(double T) const {
    const double r = 1.0 / std::min(std::max(T, T_min), T_max);
    double sum = 0.0;
    for (int k = order; k >= 0; --k) sum = sum * r + inverse[k];
    return sum;
  }
  double energy(double T) const {
    const double t = std::min(std::max(T, T_min), T_max);
    return specific_heat(T_min) * std::min(T, T_min) + integral(t) - integral(T_min) +
           specific_heat(T_max) * (std::max(T, T_max) - T_max);
  }
  double temperature(double e) const {
    if (!(e > energy(T_min))) return e / specific_heat(T_min);
    double high = 2.0 * T_min;
    while (energy(high) < e) high *= 2.0;
    const auto excess = [&](double T) { return ValueAndSlope{energy(T) - e, specific_heat(T)}; };
    return bracketed_root(excess, 0.5 * high, high, 0.75 * high);
  }

 private:
  double integral(double T) const {
    const double r = 1.0 / T;
    double sum = 0.0;
    for (int k = order; k >= 2; --k) sum = (sum + inverse[k] / (1.0 - k)) * r;
    return inverse[0] * T + (order >= 1 ? inverse[1] * std::log(T) : 0.0) + sum;
  }
};

// Coefficients a_0 ... a_n as a deck lists them. InputError for a wrong number of them, a bad
// range, or a specific heat that is not positive somewhere in the range.
PolynomialHeat polynomial_heat(std::span<const double> coefficients, int order, double T_min,
                               double T_max);

}  // namespace sluice::eos
