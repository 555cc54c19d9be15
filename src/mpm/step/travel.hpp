// How far particles go in a step, and whether they leave the domain.
#pragma once
#include <cstddef>

#include "framework/base/vec3.hpp"
#include "framework/grid/level.hpp"
#include "framework/particle/particle_set.hpp"

namespace sluice::mpm {

// The longest way of n particles from `at` on along a direction, cells.
double farthest_way(const ParticleSet& set, const ParticleSet& next, std::size_t at, int n,
                    Vec3 spacing);
bool any_outside(const Level& level, const ParticleSet& next, std::size_t at, int n);

}  // namespace sluice::mpm
