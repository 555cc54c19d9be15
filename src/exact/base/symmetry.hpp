// Distance (m) and outward direction from a plane, an axis or a point.
#pragma once
#include <cmath>

#include "framework/base/vec3.hpp"

namespace sluice::exact {

struct RadialPoint {
  double r = 0;
  Vec3 outward;  // unit vector; zero at the centre
};

// x is measured from the origin. dimension 1: |x . axis|; 2: distance from the line along the
// axis; 3: distance from the point.
inline RadialPoint radial_point(Vec3 x, int dimension, Vec3 axis) {
  Vec3 out = x;
  if (dimension == 1) out = axis * dot(x, axis);
  if (dimension == 2) out = x - axis * dot(x, axis);
  const double r = std::sqrt(dot(out, out));
  return r > 0 ? RadialPoint{r, out * (1 / r)} : RadialPoint{};
}

// Whether anything changes along direction d: not along an axis, nor across the normal of a plane.
inline bool varies_radially(int dimension, Vec3 axis, int d) {
  if (dimension == 1) return axis[d] != 0;
  return dimension == 3 || std::abs(axis[d]) != 1;
}

}  // namespace sluice::exact
