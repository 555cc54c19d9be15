// Which directions are dimensions of the run.
//
// A direction with one cell between two symmetric, two periodic or two zero-gradient faces is not
// active: no sweep, no ghost layer, no part in the time step. Its velocity component is dropped
// where it is zero for good, and carried as a passive one where a periodic or zero-gradient
// direction has it from the start or from an inflow. A direction along which gravity acts, or a
// symmetric one with a velocity along it, stays active.
#pragma once
#include <array>
#include <string>

#include "framework/scene/boundary.hpp"

namespace sluice {

inline constexpr const char* axis_letter = "xyz";  // by direction

enum class VelocityComponent { solved, dropped, carried };

struct ActiveDirection {
  bool active = true;
  VelocityComponent velocity = VelocityComponent::solved;
  std::string reason;  // one clause for `sluice plan`
  Location where;      // deck line that decided it
};

struct DirectionFacts {
  Vec3 gravity{};                // m/s^2
  std::array<bool, 3> moving{};  // a start or boundary value of the velocity is not zero
  std::array<Location, 3> moving_where;
  bool force_all = false;  // every direction active
};

std::array<ActiveDirection, 3> find_active_directions(const GridSettings& grid,
                                                      const BoundaryConditions& boundary,
                                                      const DirectionFacts& facts);

}  // namespace sluice
