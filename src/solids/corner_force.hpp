// Forces at corners of particles.
#pragma once
#include "framework/base/kept_array.hpp"
#include "framework/base/vec3.hpp"

namespace sluice::solids {

struct CornerForce {
  Vec3 place{}, force{};  // m, N
};
using CornerForces = KeptArray<CornerForce>;

}  // namespace sluice::solids
