// The value on a face of what resists in two cells, one after the other.
#pragma once
#include "ice/fluid/limiters.hpp"
#include "ice/fluid/thresholds.hpp"

namespace sluice::ice {

// 2ab/(a + b) of numbers that are not negative, 0 where both are 0. Equal values come back to the
// bit, exchanged ones give the same bits.
inline double harmonic_mean(double a, double b) {
  const double lower = smaller(a, b), higher = larger(a, b);
  return 2.0 * lower * (higher / (lower + higher + min_divisor));
}

// Where the same stress acts on both halves of what lies between two cells, the velocity between
// them is (mu_a u_a + mu_b u_b)/(mu_a + mu_b) = (u_a + u_b)/2 + tilt (u_b - u_a); 0 where the
// viscosities are equal. tilt, from -1/2 to 1/2, has no unit.
inline double velocity_tilt(double mu_a, double mu_b) {
  return 0.5 * (mu_b - mu_a) / (mu_a + mu_b + min_divisor);
}

}  // namespace sluice::ice
