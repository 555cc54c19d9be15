// Three by three matrices, row after row.
#pragma once
#include <array>

#include "framework/base/vec3.hpp"

namespace sluice::mpm {

using Map = std::array<double, 9>;

constexpr double determinant(const Map& a) {
  return a[0] * (a[4] * a[8] - a[5] * a[7]) - a[1] * (a[3] * a[8] - a[5] * a[6]) +
         a[2] * (a[3] * a[7] - a[4] * a[6]);
}

constexpr Vec3 applied(const Map& a, Vec3 x) {
  return {a[0] * x.x + a[1] * x.y + a[2] * x.z, a[3] * x.x + a[4] * x.y + a[5] * x.z,
          a[6] * x.x + a[7] * x.y + a[8] * x.z};
}

// The determinant must not be zero.
constexpr Map inverse(const Map& a) {
  const double s = 1 / determinant(a);
  return {s * (a[4] * a[8] - a[5] * a[7]), s * (a[2] * a[7] - a[1] * a[8]),
          s * (a[1] * a[5] - a[2] * a[4]), s * (a[5] * a[6] - a[3] * a[8]),
          s * (a[0] * a[8] - a[2] * a[6]), s * (a[2] * a[3] - a[0] * a[5]),
          s * (a[3] * a[7] - a[4] * a[6]), s * (a[1] * a[6] - a[0] * a[7]),
          s * (a[0] * a[4] - a[1] * a[3])};
}

}  // namespace sluice::mpm
