// Small functions of the row kernels of scalars.
#pragma once
#include "ice/fluid/shared_mass.hpp"

namespace sluice::ice::scalars {

// The share of a material's mass that is still there after a step, at least: N is the share of the
// cell that flows out, V that which the material fills. All where it fills the cell, as N < 1.
inline double staying_share(double volume, double N) {
  const double least = 0.5 * larger(volume - N, 0.0) / larger(volume, min_divisor);
  return volume < 1.0 ? least : 1.0;
}

}  // namespace sluice::ice::scalars
