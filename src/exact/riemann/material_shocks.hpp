// Shocks in one material, waves that a moving wall makes, and a shock that meets an interface.
//
// Directions: 1 a wave that runs to higher x, -1 to lower x. Velocities and speeds are those of the
// frame in which the state ahead is given. SI units: Pa, m/s, m, s, K.
// Reference: L. D. Landau and E. M. Lifshitz, Fluid Mechanics, 2nd ed. (Pergamon, 1987), sections
// 85, 99, 100.
#pragma once
#include <optional>

#include "exact/riemann/material_riemann.hpp"

namespace sluice::exact {

struct Wave {
  FluidState behind;
  double head = 0, tail = 0;  // equal for a shock
};

// The wave into `ahead.state` that leaves this pressure behind it. This and the next two throw
// InputError for another direction, a Mach number not above 1, and a wall so fast that a void
// opens.
Wave wave_to_pressure(const MaterialSide& ahead, double pressure, int direction);
// A shock at this multiple (> 1) of the speed of sound ahead.
Wave shock_of_mach(const MaterialSide& ahead, double mach, int direction);
// The wave from a wall (or piston) of this velocity: a reflected shock, water hammer, or a fan
// where the wall draws back.
Wave wave_from_wall(const MaterialSide& ahead, double wall_velocity, int direction);

// A shock runs to higher x through the first material, into uniform fluid, and meets at
// `interface_position` the second one or, without a second one, a rigid wall.
class ShockMeetsInterface {
 public:
  // first: the state ahead of the shock. Throws InputError unless both materials move together at
  // one pressure before, and the shock starts left of the interface (a wall must move with them).
  ShockMeetsInterface(const MaterialSide& first, const std::optional<MaterialSide>& second,
                      double pressure_behind, double shock_position, double interface_position);

  const Wave& incident() const { return incident_; }
  double arrival_time() const { return arrival_; }
  double arrival_position() const { return arrival_position_; }
  // Waves after the arrival, about arrival time and position. With a wall its right half is the
  // mirror image.
  const MaterialRiemann& after() const { return after_; }

  MaterialRiemann::Sample at(double x, double t) const;
  double temperature(const MaterialRiemann::Sample& sample) const;

 private:
  MaterialSide first_, second_;
  double shock_position_, interface_position_;
  Wave incident_;
  double arrival_, arrival_position_;
  MaterialRiemann after_;
};

}  // namespace sluice::exact
