// Slope limiters of the conservative scheme; odd and mirror-exact, no division. Differences and
// slopes of any quantity, in its unit per cell; nu and B have no unit.
#pragma once
#include <cmath>

namespace sluice::ice {

inline double smaller(double a, double b) {
  return a < b ? a : b;
}
inline double larger(double a, double b) {
  return a > b ? a : b;
}

// Central slope of two one-sided differences, at most 1.5 times the smaller one:
//   L3(a,b) = 0 if ab <= 0, else sign min(|a+b|/2, 1.5 min(|a|,|b|)).
inline double central_slope(double a, double b) {
  const double s = 0.5 * (a + b);
  const double bound = 1.5 * smaller(std::fabs(a), std::fabs(b));
  const double r = std::copysign(smaller(std::fabs(s), bound), s);
  return a * b > 0.0 ? r : 0.0;
}

// Third-order upwind-biased slope for a flux at Courant number nu. dm: difference on the upwind
// side of the donor, dp: on the downwind side. B bounds the slope by the upwind difference.
//   Q3 = 0 if dm dp <= 0, else ((2-nu) dp + (1+nu) dm)/3 with |Q3| <= min(B |dm|, 2 |dp|).
inline double upwind_slope(double dm, double dp, double nu, double B) {
  const double s = ((2.0 - nu) * dp + (1.0 + nu) * dm) * (1.0 / 3.0);
  const double bound = smaller(B * std::fabs(dm), 2.0 * std::fabs(dp));
  const double r = std::copysign(smaller(std::fabs(s), bound), s);
  return dm * dp > 0.0 ? r : 0.0;
}

}  // namespace sluice::ice
