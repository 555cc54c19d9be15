// Between the limits of low and high pressure of a falloff reaction.
//
//   k = k_inf P/(1 + P) F,   P = k_0 [M]/k_inf
// Lindemann: F = 1. Troe, with lg the logarithm to base 10:
//   lg F = lg Fc/(1 + f^2),  f = x/(n - 0.14 x),  x = lg P + c,
//   c = -0.4 - 0.67 lg Fc,  n = 0.75 - 1.27 lg Fc,
//   Fc = (1 - a) exp(-T/T***) + a exp(-T/T*) + exp(-T**/T), the last where T** is given
// P, F and Fc have no units; T is in K.
// Reference: Gilbert, Luther, Troe, Ber. Bunsenges. Phys. Chem. 87 (1983) 169.
#pragma once
#include <algorithm>
#include <cmath>

#include "kinetics/mechanism.hpp"

namespace sluice::kinetics {

struct ValueAndSlope {
  double value = 0, slope = 0;
};

// lg Fc and its derivative by T, 1/K.
inline ValueAndSlope log_centre(const Falloff& falloff, double T) {
  const double one = (1 - falloff.a) * std::exp(-T / falloff.T3);
  const double other = falloff.a * std::exp(-T / falloff.T1);
  double centre = one + other;
  double slope = -one / falloff.T3 - other / falloff.T1;
  if (falloff.T2) {
    const double last = std::exp(-*falloff.T2 / T);
    centre += last;
    slope += last * *falloff.T2 / (T * T);
  }
  constexpr double least = 1e-30;
  if (!(centre > least)) return {std::log10(least), 0};
  return {std::log10(centre), slope / centre / std::log(10.0)};
}

struct FalloffFactor {
  double value = 0;      // P/(1 + P) F
  double by_log_P = 0;   // d ln(value)/d ln P
  double by_centre = 0;  // d ln(value)/d lg Fc
};

inline FalloffFactor falloff_factor(double P, bool troe, double log_Fc) {
  FalloffFactor factor;
  P = std::max(P, 1e-300);
  const double base = 1 / (1 + P);
  factor.value = P * base;
  factor.by_log_P = base;
  if (!troe) return factor;
  const double n = 0.75 - 1.27 * log_Fc;
  const double x = std::log10(P) - 0.4 - 0.67 * log_Fc;
  const double bottom = 1 / (n - 0.14 * x), f = x * bottom;
  const double share = 1 / (1 + f * f);
  const double by_f = -2 * f * share * share * log_Fc;  // of lg F
  const double ln10 = std::log(10.0);
  factor.value *= std::exp(ln10 * log_Fc * share);
  factor.by_log_P += by_f * n * bottom * bottom;
  factor.by_centre = ln10 * (share + by_f * (1.27 * x - 0.67 * n) * bottom * bottom);
  return factor;
}

}  // namespace sluice::kinetics
