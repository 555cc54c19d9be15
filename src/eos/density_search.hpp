// Density at a pressure: the root of p(rho) nearest to a start density, bracketed outwards.
#pragma once
#include <algorithm>
#include <cmath>
#include <limits>

#include "eos/bracketed_root.hpp"

namespace sluice::eos {

// The answer where a law has no state at the pressure and temperature asked for.
inline constexpr double no_density = std::numeric_limits<double>::quiet_NaN();

// Pressures in Pa, densities in kg/m^3. `isotherm(rho)` gives pressure and slope. Goes up from
// `start` where pressure is missing, down where there is too much, in growing steps, so that of
// several roots the nearest stable one is found; `top` is the density that is never reached.
template <class Isotherm>
double search_density(double p, double start, double top, const Isotherm& isotherm) {
  double low = start, high = start, factor = 1.1;
  const double at_start = isotherm(start).value;
  if (at_start < p) {
    for (; isotherm(high).value < p; factor *= factor) {
      low = high;
      high = std::min(factor * high, high + 0.5 * (top - high));
      if (!(high > low) || !std::isfinite(high)) return no_density;
    }
    if (!(isotherm(high).value >= p)) return no_density;
  } else {
    for (; isotherm(low).value > p; factor *= factor) {
      high = low;
      low /= factor;
      if (!(low > std::numeric_limits<double>::min())) return no_density;
    }
    if (!(isotherm(low).value <= p)) return no_density;
  }
  const auto excess = [&](double rho) {
    const ValueAndSlope at = isotherm(rho);
    return ValueAndSlope{at.value - p, at.slope};
  };
  return bracketed_root(excess, low, high, middle_of(low, high));
}

}  // namespace sluice::eos
