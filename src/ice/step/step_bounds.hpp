// How long a step of the conservative scheme may be for the waves it carries.
#pragma once
#include "ice/step/variables.hpp"

namespace sluice::ice {

// Small waves in all directions at once grow above 1.08 (measured on cubic cells: up to 1.08 in
// 2-D, 1.11 in 3-D they do not). The classic form has a bound of its own.
// threshold: dt (|u| + c)/dx in one direction, at most; unit: 1; test: none
constexpr double max_in_one_direction = 0.8;
// threshold: dt (|u| + c)/dx summed over directions, at most; unit: 1; test: SmallWaves.DoNotGrow
constexpr double max_in_all = 1.0;

// Share (0 to 1) of the sum that counts as the rate of sound.
inline double sound_sum_share(const SchemeOptions& o) {
  return o.scheme.internal_energy_form ? 0.0 : max_in_one_direction / max_in_all;
}

}  // namespace sluice::ice
