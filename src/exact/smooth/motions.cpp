#include "exact/smooth/motions.hpp"

#include <cmath>
#include <numbers>

#include "framework/base/error.hpp"

namespace sluice::exact {
State Motion::at(Vec3, double) const {
  throw InputError("the exact solution is a motion: it gives only p.x");
}

Vec3 VortexRing::place(Vec3 X, double t) const {
  const double s = std::hypot(X.x, X.y) - 1, root = 16 * s * s - 1;
  const double angle = amplitude_ / 2 * (1 - std::cos(2 * std::numbers::pi * t)) * root * root;
  const double c = std::cos(angle), d = std::sin(angle);
  return {c * X.x - d * X.y, d * X.x + c * X.y, X.z};
}

Vec3 AxisAligned::place(Vec3 X, double t) const {
  Vec3 x = X;
  for (int d = 0; d < directions_; ++d) {
    const double sign = d == 1 ? -1 : 1;
    x[d] += sign * amplitude_ * std::sin(2 * std::numbers::pi * X[d]) *
            std::sin(speed_ * std::numbers::pi * t);
  }
  return x;
}

}  // namespace sluice::exact
