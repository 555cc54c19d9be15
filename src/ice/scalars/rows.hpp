// Small functions of the row kernels of scalars.
#pragma once
#include "ice/fluid/limiters.hpp"

namespace sluice::ice::scalars {

// Divisors are kept above this: what it stands for has no mass, and nothing of it passes.
constexpr double least_mass = 1e-300;

// b - a between two cells that both hold the material; 0 otherwise.
inline double difference(double a, double b, double mass_a, double mass_b) {
  return mass_a > 0.0 && mass_b > 0.0 ? b - a : 0.0;
}

// Mass per volume through which a scalar spreads from one cell to the other: the harmonic mean.
inline double shared_mass(double a, double b) {
  return 2.0 * (a * b) / larger(a + b, least_mass);
}

// The share of a material's mass that is still there after a step, at least: N is the share of the
// cell that flows out, V that which the material fills. All where it fills the cell, as N < 1.
inline double staying_share(double volume, double N) {
  const double least = 0.5 * larger(volume - N, 0.0) / larger(volume, least_mass);
  return volume < 1.0 ? least : 1.0;
}

}  // namespace sluice::ice::scalars
