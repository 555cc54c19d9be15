// What a boundary region says about one material, and about all of them together, as numbers.
#pragma once
#include <span>
#include <vector>

#include "framework/scene/boundary.hpp"
#include "ice/deck/flow_conditions.hpp"
#include "ice/deck/ice_scene.hpp"

namespace sluice::ice {

constexpr double unfilled = 1e-6;  // of a cell: volumes are given with as many digits

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
  enum class Velocity { copy, mirror, wall, slip, prescribed, sine, power_law, log_law, vortices };
  Velocity velocity_kind = Velocity::copy;
  Vec3 velocity{};           // wall, wall with slip, prescribed or of a profile
  Vec3 velocity_gradient{};  // copy
  bool fixed_density = false, fixed_pressure = false, fixed_temperature = false;
  double density = 0, pressure = 0, temperature = 0;
  double specific_volume = 0;  // given with the density; 0: what fills the cell follows from it
  bool sine_pressure = false;
  bool vortex_pressure = false;  // of TravellingVortices
  bool creep = false;            // slip: towards warmer gas along the wall
  bool waves = false;            // waves.hpp; what is fixed stays so
  int open_face = -1;            // of those without a velocity far away: open_faces.cpp
  WallHeat heat;                 // of walls, through conduction only; not of symmetry planes
  double density_gradient = 0, pressure_gradient = 0, temperature_gradient = 0;

  bool mirrored() const {
    return velocity_kind == Velocity::mirror || velocity_kind == Velocity::wall ||
           velocity_kind == Velocity::slip;
  }
  SideKind side_kind() const;
  // The velocity through the face is as given, whatever is inside. A swing of pressure and velocity
  // is a wave that runs in, the exact flow of vortices a state on both sides.
  bool holds_velocity() const {
    return side_kind() == SideKind::velocity && !sine_pressure &&
           velocity_kind != Velocity::vortices;
  }
  // The conserved state is copied (or mirrored) as it is.
  bool plain() const;
};

// Throws InputError naming the deck line of a condition that is not built, or whose block
// (<LODI>, <SINE_BC>, <inletVelocity>, <microSlip>) is missing.
GhostRule make_rule(const BoundaryRegion& region, int material, int normal,
                    const FlowConditions& conditions);

// Of a gas that fills its cells alone; also refuses a SpecificVol that is not 1/Density.
GhostRule make_gas_rule(const BoundaryRegion& region, int material, int normal,
                        const FlowConditions& conditions);

// Of several materials with one velocity and one pressure. Densities given are masses per volume
// of the cell. Where all are given, what each fills follows from the specific volumes given, or
// from temperatures and pressure; a pressure that is not given is the one at which they fill the
// cell. Less than 1e-9 of the largest density means absent.
struct MixtureRule {
  struct Part {
    GhostRule rule;
    bool absent = false;
    double volume = -1;  // share of the cell, where known beforehand
  };
  std::vector<Part> parts;  // by material
  // Plain where all are so alike; mirrored where those present are. Also the pressure.
  GhostRule common;
  bool plain = false;
};

// Throws InputError for conditions that contradict each other: a wall for some materials only,
// volumes that do not fill the cell, or too little to know them.
MixtureRule make_mixture_rule(const BoundaryRegion& region, std::span<const IceMaterial> materials,
                              int normal, const FlowConditions& conditions);

}  // namespace sluice::ice
