#include "exact/base/error_norms.hpp"

#include <fmt/format.h>

#include <cmath>

#include "framework/base/error.hpp"
#include "framework/base/exact_sum.hpp"

namespace sluice::exact {

double exact_value(const State& state, const std::string& variable, int component,
                   double specific_heat) {
  if (variable == "rho_CC") return state.density;
  if (variable == "press_CC") return state.pressure;
  if (variable == "temp_CC") return state.temperature(specific_heat);
  if (variable == "sp_vol_CC") return 1 / state.density;
  if (variable == "vel_CC") return state.velocity[component];
  throw InputError(fmt::format(
      "variable '{}' has no exact value; known are rho_CC, press_CC, temp_CC, vel_CC, sp_vol_CC",
      variable));
}

ErrorNorms error_norms(const std::vector<double>& computed, const std::vector<double>& exact,
                       const std::vector<double>& volumes, double offset) {
  const bool weighted = !volumes.empty();
  if (computed.size() != exact.size() || computed.empty() ||
      (weighted && volumes.size() != exact.size())) {
    throw InputError(
        fmt::format("error norms: {} computed values, {} exact ones and {} volumes; their numbers "
                    "must be equal and at least 1",
                    computed.size(), exact.size(), volumes.size()));
  }
  ErrorNorms norms;
  ExactSum absolute, squares, size, all;
  for (std::size_t i = 0; i < computed.size(); ++i) {
    const double d = std::abs(computed[i] - exact[i]), w = weighted ? volumes[i] : 1.0;
    absolute.add(w * d);
    squares.add(w * d * d);
    size.add(w * std::abs(exact[i] - offset));
    all.add(w);
    if (std::isnan(d) || d > norms.linf) norms.linf = d;  // a NaN stays: nothing exceeds it
  }
  norms.points = computed.size();
  norms.l1 = absolute.value() / all.value();
  norms.l2 = std::sqrt(squares.value() / all.value());
  norms.relative_l1 = absolute.value() / size.value();
  return norms;
}

}  // namespace sluice::exact
