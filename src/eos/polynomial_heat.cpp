// Checks of the coefficients of a polynomial specific heat.
#include "eos/polynomial_heat.hpp"

#include <string>

#include "framework/base/error.hpp"

namespace sluice::eos {
namespace {

void check_positive(const PolynomialHeat& heat) {
  const int samples = 1000;
  for (int i = 0; i <= samples; ++i) {
    const double T = heat.T_min * std::pow(heat.T_max / heat.T_min, double(i) / samples);
    if (!(heat.specific_heat(T) > 0.0))
      throw InputError(
          "Polynomial specific heat is " + std::to_string(heat.specific_heat(T)) + " J/(kg K) at " +
          std::to_string(T) +
          " K; it must be positive from Tmin to Tmax: raise Tmin or check coefficient");
  }
}

}  // namespace

PolynomialHeat polynomial_heat(std::span<const double> coefficients, int order, double T_min,
                               double T_max) {
  if (order < 0 || order > PolynomialHeat::max_order)
    throw InputError("MaxOrder of a Polynomial specific heat is " + std::to_string(order) +
                     "; allowed are 0 to " + std::to_string(PolynomialHeat::max_order));
  if (coefficients.size() != static_cast<std::size_t>(order) + 1)
    throw InputError("Polynomial specific heat of MaxOrder " + std::to_string(order) + " has " +
                     std::to_string(coefficients.size()) + " coefficients; it needs " +
                     std::to_string(order + 1) + ", a_0 first");
  if (!(T_min > 0.0 && T_max > T_min))
    throw InputError("Polynomial specific heat has Tmin " + std::to_string(T_min) + " and Tmax " +
                     std::to_string(T_max) + " K; needed is 0 < Tmin < Tmax");
  PolynomialHeat heat{.order = order, .T_min = T_min, .T_max = T_max};
  for (int k = 0; k <= order; ++k) heat.inverse[k] = coefficients[order - k];
  check_positive(heat);
  return heat;
}

}  // namespace sluice::eos
