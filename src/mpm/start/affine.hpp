// Affine maps of places: three by three matrices, without unit, row after row.
#pragma once
#include "framework/base/vec3.hpp"
#include "mpm/material/base/tensor.hpp"

namespace sluice::mpm {

using Map = Matrix;

constexpr Vec3 applied(const Map& a, Vec3 x) {
  return {a[0] * x.x + a[1] * x.y + a[2] * x.z, a[3] * x.x + a[4] * x.y + a[5] * x.z,
          a[6] * x.x + a[7] * x.y + a[8] * x.z};
}

}  // namespace sluice::mpm
