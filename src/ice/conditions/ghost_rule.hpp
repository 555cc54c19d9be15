// What a boundary region says about one material, as numbers: how its ghosts are filled.
#pragma once
#include <memory>

#include "framework/base/vec3.hpp"
#include "ice/conditions/prescribed_flow.hpp"

namespace sluice::ice {

// What a face on a side of the domain makes of a pressure that is solved for (pressure/faces.cpp):
// its velocity is 0, given, or that of the cell inside; its pressure is given; waves leave.
enum class SideKind { wall, velocity, copied, pressure, open };

// What a wall does to heat: it has a temperature of its own, or a gradient along the inward normal.
struct WallHeat {
  bool fixed = false, slip = false;      // slip: fixed, but the gas at the wall has another
  double temperature = 0, gradient = 0;  // K, K/m
};

// One region's conditions for one material.
struct GhostRule {
  enum class Velocity { copy, mirror, wall, slip, prescribed, flow };
  Velocity velocity_kind = Velocity::copy;
  Vec3 velocity{};           // wall, wall with slip, prescribed or scaled by a flow, m/s
  Vec3 velocity_gradient{};  // copy, along the inward normal, 1/s
  bool fixed_density = false, fixed_pressure = false, fixed_temperature = false;
  double density = 0, pressure = 0, temperature = 0;  // kg/m^3, Pa, K
  double specific_volume = 0;  // m^3/kg, given with the density; 0: what fills the cell follows
  std::shared_ptr<const PrescribedFlow> velocity_flow;  // of Velocity::flow
  std::shared_ptr<const PrescribedFlow> pressure_flow;  // null: another rule gives the pressure
  bool creep = false;                                   // slip: towards warmer gas along the wall
  bool waves = false;  // boundary/waves.hpp; what is fixed stays so
  int open_face = -1;  // of those without a velocity far away: boundary/open_faces.cpp
  WallHeat heat;       // of walls, through conduction only; not of symmetry planes
  // Along the inward normal: kg/m^4, Pa/m, K/m.
  double density_gradient = 0, pressure_gradient = 0, temperature_gradient = 0;

  bool mirrored() const {
    return velocity_kind == Velocity::mirror || velocity_kind == Velocity::wall ||
           velocity_kind == Velocity::slip;
  }
  bool exact_flow() const { return is_exact(velocity_flow.get()) || is_exact(pressure_flow.get()); }
  bool gives_pressure() const { return fixed_pressure || pressure_flow != nullptr; }
  SideKind side_kind() const;
  // The velocity through the face is as given, whatever is inside. A swing of pressure and velocity
  // is a wave that runs in, an exact flow a state on both sides.
  bool holds_velocity() const {
    return side_kind() == SideKind::velocity && pressure_flow == nullptr && !exact_flow();
  }
  // The conserved state is copied (or mirrored) as it is.
  bool plain() const;

 private:
  static bool is_exact(const PrescribedFlow* flow) {
    return flow != nullptr && flow->nature() == PrescribedFlow::Nature::exact;
  }
};

}  // namespace sluice::ice
