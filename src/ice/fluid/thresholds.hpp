// What all rooms of the fluid keep divisors above.
#pragma once

namespace sluice::ice {

// threshold: divisors are kept above this, so that the quotient is 0 where nothing of a material
//   or of its viscosity is there; unit: that of the divisor; test:
//   ScalarInMixtures.NeverLeavesItsMaterial
constexpr double min_divisor = 1e-300;

}  // namespace sluice::ice
