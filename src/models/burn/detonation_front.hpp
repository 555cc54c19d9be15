// The front of a prescribed detonation (programmed burn, Wilkins 1964): it leaves a point, or a
// plane to both sides. Cells (LightTime) and particles (program_burn) burn by it alike. Places and
// distances in m.
#pragma once
#include <cmath>

#include "framework/base/vec3.hpp"

namespace sluice::models {

struct DetonationFront {
  static constexpr double width = 1.5;  // over which it burns, edges of cells or particles
  static constexpr double all = 0.96;   // burned share from which everything has burned

  Vec3 start{};
  Vec3 normal{};  // of the plane, of length 1; 0: from a point

  double distance(Vec3 x) const {
    const Vec3 way = x - start;
    return normal == Vec3{} ? std::sqrt(dot(way, way)) : std::abs(dot(way, normal));
  }
};

// A normal of any length.
inline DetonationFront detonation_front(Vec3 start, Vec3 normal) {
  const double size = std::hypot(normal.x, normal.y, normal.z);
  return {start, size > 0 ? normal * (1 / size) : normal};
}

}  // namespace sluice::models
