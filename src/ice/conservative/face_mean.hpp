// The value on a face of what resists in two cells, one after the other.
#pragma once
#include "ice/limiters.hpp"

namespace sluice::ice {

// 2ab/(a + b) of numbers that are not negative, 0 where both are 0. Equal values come back to the
// bit, exchanged ones give the same bits.
inline double harmonic_mean(double a, double b) {
  constexpr double nothing = 1e-300;
  const double lower = smaller(a, b), higher = larger(a, b);
  return 2.0 * lower * (higher / (lower + higher + nothing));
}

}  // namespace sluice::ice
