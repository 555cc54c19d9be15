// What two cells that both hold a material share.
#pragma once
#include "ice/fluid/limiters.hpp"
#include "ice/fluid/thresholds.hpp"

namespace sluice::ice {

// b - a, of any quantity, between two cells that both hold the material (masses in kg/m^3); 0
// otherwise.
inline double difference(double a, double b, double mass_a, double mass_b) {
  return mass_a > 0.0 && mass_b > 0.0 ? b - a : 0.0;
}

// Mass per volume (kg/m^3) through which a scalar spreads from one cell to the other: the harmonic
// mean.
inline double shared_mass(double a, double b) {
  return 2.0 * (a * b) / larger(a + b, min_divisor);
}

}  // namespace sluice::ice
