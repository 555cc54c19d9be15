// When a source acts: from `start` to `stop`, also where these lie inside a step. All times in s.
#pragma once
#include <algorithm>
#include <limits>

namespace sluice::models {

struct TimeWindow {
  double start = 0;
  double stop = std::numeric_limits<double>::infinity();

  // How long it acts in a step of length dt that begins at `time`.
  double overlap(double time, double dt) const {
    if (start <= time && time + dt <= stop) return dt;
    return std::max(0.0, std::min(time + dt, stop) - std::max(time, start));
  }
};

}  // namespace sluice::models
