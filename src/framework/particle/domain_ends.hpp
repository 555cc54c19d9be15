// What becomes of a particle that a step has taken out of the domain. Points in m.
#pragma once
#include <functional>

#include "framework/grid/level.hpp"
#include "framework/grid/side.hpp"

namespace sluice {

// Does the boundary throw particles back at the face of this cell; else it lets them out.
using Reflects = std::function<bool(Side side, IntVec3 cell)>;

// Periodic directions are wrapped, walls mirror. False: it has left, and is where it left.
bool bring_inside(const Level& level, const Reflects& reflects, Vec3& point);

}  // namespace sluice
