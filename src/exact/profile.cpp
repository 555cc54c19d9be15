#include "exact/profile.hpp"

#include <fmt/format.h>

#include <cmath>
#include <ostream>

#include "framework/base/error.hpp"
#include "framework/base/exact_sum.hpp"

namespace sluice::exact {

void write_profile(std::ostream& out, const ExactSolution& solution,
                   const std::vector<Vec3>& points, double time, double specific_heat) {
  out << "x,y,z,density,velocity_x,velocity_y,velocity_z,pressure,temperature\n";
  for (const Vec3& x : points) {
    const State s = solution.at(x, time);
    out << fmt::format("{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g}\n",
                       x.x, x.y, x.z, s.density, s.velocity.x, s.velocity.y, s.velocity.z,
                       s.pressure, s.temperature(specific_heat));
  }
}

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

ErrorNorms error_norms(const std::vector<double>& computed, const std::vector<double>& exact) {
  if (computed.size() != exact.size() || computed.empty()) {
    throw InputError(
        fmt::format("error norms: {} computed and {} exact values; expected as many "
                    "of each, at least one",
                    computed.size(), exact.size()));
  }
  ErrorNorms norms;
  ExactSum absolute, squares, size;
  for (std::size_t i = 0; i < computed.size(); ++i) {
    const double d = std::abs(computed[i] - exact[i]);
    absolute.add(d);
    squares.add(d * d);
    size.add(std::abs(exact[i]));
    if (std::isnan(d) || d > norms.linf) norms.linf = d;  // a NaN stays: nothing exceeds it
  }
  const auto count = static_cast<double>(computed.size());
  norms.points = computed.size();
  norms.l1 = absolute.value() / count;
  norms.l2 = std::sqrt(squares.value() / count);
  norms.relative_l1 = absolute.value() / size.value();
  return norms;
}

}  // namespace sluice::exact
