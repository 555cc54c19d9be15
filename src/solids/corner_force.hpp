// A force at a corner of a particle.
#pragma once
#include "framework/base/vec3.hpp"

namespace sluice::solids {

struct CornerForce {
  Vec3 place{}, force{};  // m, N
};

}  // namespace sluice::solids
