// The prescribed motion of a master: v(x) = v + omega x (x - o), from a profile by time.
#pragma once
#include <array>

#include "mpm/deck/mpm_scene.hpp"

namespace sluice::mpm {

// The motion in one step, constant in it.
struct MasterMotion {
  Vec3 velocity{}, origin{}, spin{};  // m/s, m, 1/s
  bool rotates = false;
  double dt = 1;  // s

  // Way of a place in the step over dt; with a rotation it stays on its circle:
  // v + (R - 1)(x - o)/dt, R: rotation by |omega| dt about omega.
  Vec3 at(Vec3 x) const;
  // (R - 1)/dt, row after row: gradient of at().
  std::array<double, 9> gradient() const;
};

// Is the master's motion prescribed during a step: by a file, or since it was stopped.
bool is_prescribed(const ContactRule& rule, double time, double dt);

// The mean of the profile over the step, so that ways are exact whatever the steps. Rows are joined
// by straight lines; before the first and after the last they go on as these are. From stop_time
// on velocity_after_stop, without rotation.
MasterMotion motion_in_step(const ContactRule& rule, double time, double dt);

}  // namespace sluice::mpm
