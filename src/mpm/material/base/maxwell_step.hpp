// A Maxwell element in a step of constant rate of strain, exact for any length of the step:
//
//   S' = 2 G D' - S/tau,   x = dt/tau:   S <- e^-x S + 2 G dt D' (1 - e^-x)/x
#pragma once
#include <cmath>

namespace sluice::mpm {

// Factors without unit.
struct MaxwellStep {
  double kept;   // e^-x
  double taken;  // (1 - e^-x)/x
};
inline MaxwellStep maxwell_step(double x) {
  return {std::exp(-x), x < 1e-8 ? 1 - 0.5 * x : -std::expm1(-x) / x};
}

}  // namespace sluice::mpm
