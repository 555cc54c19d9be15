// What cases of semi-implicit steps share: overrides that turn the solve on, and steps of a length.
#pragma once
#include <fmt/format.h>

#include <string>
#include <vector>

namespace sluice::verification {

using Overrides = std::vector<std::string>;

inline Overrides operator+(Overrides a, const Overrides& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

// The pressure is solved for, with that many passes in a step at most.
inline Overrides solved(int passes = 1, double tolerance = 1e-6, double linear = 1e-8) {
  const std::string at = "CFD/ICE/ImplicitSolver/";
  return {at + fmt::format("max_outer_iterations={}", passes),
          at + fmt::format("outer_iteration_tolerance={:g}", tolerance),
          at + fmt::format("Parameters/tolerance={:g}", linear)};
}

// Sound does not count for the length of a step.
inline Overrides sound_is_free() {
  return {"CFD/ICE/TimeStepControl/knob_for_speedSound=0"};
}

// So many steps of that length, with that many outputs behind the first.
inline Overrides steps_of(double dt, int steps, int outputs = 1) {
  const double end = dt * steps;
  return sound_is_free() +
         Overrides{fmt::format("Time/delt_max={:.17g}", dt),
                   fmt::format("Time/delt_init={:.17g}", dt),
                   fmt::format("Time/maxTime={:.17g}", end),
                   fmt::format("DataArchiver/outputInterval={:.17g}", end / outputs)};
}

inline Overrides until(double time) {
  return {fmt::format("Time/maxTime={:.17g}", time),
          fmt::format("DataArchiver/outputInterval={:.17g}", time)};
}

}  // namespace sluice::verification
