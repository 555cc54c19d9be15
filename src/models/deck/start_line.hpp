// Values along one axis: linear between points, constant beyond the first and the last.
#pragma once
#include <algorithm>
#include <cstddef>
#include <vector>

#include "framework/base/vec3.hpp"

namespace sluice::models {

struct StartLine {
  int axis = 0;
  std::vector<double> x;       // m, increasing, at least one
  std::vector<double> values;  // at these, in the SI unit of what they are of

  double at(Vec3 point) const {
    const double along = point[axis];
    const auto above = std::upper_bound(x.begin(), x.end(), along);
    if (above == x.begin()) return values.front();
    if (above == x.end()) return values.back();
    const std::size_t n = above - x.begin();
    const double weight = (along - x[n - 1]) / (x[n] - x[n - 1]);
    return values[n - 1] + weight * (values[n] - values[n - 1]);
  }
};

}  // namespace sluice::models
