// The classic form of ICE: one stage, internal energy balanced.
//
// Face velocity from density-weighted means and the pressure gradient, pressure change from the
// divergence of the face velocity, face pressure weighted with the opposite density, volume work,
// advection of mass, momentum and internal energy. Limits: total energy is not conserved and shocks
// have wrong speeds and strengths; it is there for comparison.
// References: B. A. Kashiwa et al., A cell-centered ICE method for multiphase flow simulations,
// LA-UR-93-3922 (1994); J. E. Guilkey, T. B. Harman and B. Banerjee, Comput. Struct. 85 (2007) 660.
//
// Step numbers in this folder are those of docs/theory/ice_classic.md.
// Lengths are in cells: a slope is the difference across one cell, l = dt/dx.
#pragma once
#include "ice/step/variables.hpp"

namespace sluice::ice::internal_energy_form {

struct Variables {
  SchemeVariables common;  // state, primitives, faces, stress, impulse, E* (energy after work)
  VariableId pressure;     // p + dp, that acts in this step
  VariableId energy;       // advected: specific (or per volume, as the fluxes are)
  VariableId momentum;     // advected alike
  VariableId slope;        // limited: D of density, D of energy, D of each momentum component
  VariableId shift;        // by axis: how far the rest of a cell lies from its centre
  VariableId rest;         // share of a cell that does not flow out
};

// The fluxes of energy and momentum are mass flux times specific value: "compatible" fluxes.
inline bool specific(const SchemeOptions& o) {
  return !o.scheme.second_order || o.scheme.compatible_fluxes;
}

// Place of the slope of quantity q (0 density, 1 energy, 2 + c momentum) along an axis.
inline int slope_index(int quantity, int axis, int axes) {
  return quantity * axes + axis;
}

// Tasks of the step, in order; each in the file of its name, with what it reads and writes.
struct FaceVelocityInput {
  VariableId rho, velocity, pressure, sound;
  std::array<VariableId, 3> face_velocity;  // written

  static FaceVelocityInput of(const Variables&);
};
void add_face_velocity(TaskList&, const FaceVelocityInput&, const SchemeOptions&, int effect);

struct PressureChangeInput {
  VariableId energy, inverse_rho, pressure, sound;
  std::array<VariableId, 3> face_velocity;
  VariableId pressure_change, acting_pressure, energy_star;  // written

  static PressureChangeInput of(const Variables&);
};
void add_pressure_change(TaskList&, const PressureChangeInput&, const SchemeOptions&, int effect);

struct FacePressureInput {
  VariableId rho, velocity, sound, pressure;
  std::array<VariableId, 3> face_pressure;  // written

  static FacePressureInput of(const Variables&);
};
void add_face_pressure(TaskList&, const FacePressureInput&, const SchemeOptions&, int effect);

struct LagrangianInput {
  VariableId rho, inverse_rho, old_momentum, energy_star, velocity, sound;
  std::array<VariableId, 3> face_pressure, stress;
  VariableId impulse, momentum, energy;  // written

  static LagrangianInput of(const Variables&);
};
void add_lagrangian(TaskList&, const LagrangianInput&, const SchemeOptions&, int effect);

struct SlopesInput {
  VariableId rho, mask, energy, momentum;
  std::array<VariableId, 3> face_velocity;
  VariableId slope, shift;  // written

  static SlopesInput of(const Variables&);
};
void add_slopes(TaskList&, const SlopesInput&, const SchemeOptions&, int effect);

struct FluxesInput {
  VariableId rho, energy, momentum, slope, shift;
  std::array<VariableId, 3> face_velocity;
  std::array<VariableId, 3> flux;  // written

  static FluxesInput of(const Variables&);
};
void add_fluxes(TaskList&, const FluxesInput&, const SchemeOptions&, int effect);

struct UpdateInput {
  VariableId rho, momentum, impulse, energy_star, sound;
  std::array<VariableId, 3> face_velocity, flux;
  VariableId rest, rho_new, momentum_new, energy_new, source_change;  // written

  static UpdateInput of(const Variables&);
};
void add_update(TaskList&, const UpdateInput&, const SchemeOptions&, int effect);

// Ghost layers of state that the step needs so that nothing is exchanged inside it.
inline int ghost_layers(const SchemeOptions& o) {
  return o.scheme.second_order ? 4 : 3;
}

}  // namespace sluice::ice::internal_energy_form
