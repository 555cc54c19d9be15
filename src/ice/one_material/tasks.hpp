// Tasks of a step of one material in the default scheme, in order; each in the file of its name,
// with what it reads and writes.
#pragma once
#include "ice/step/end_of_step.hpp"
#include "ice/step/shock_shear.hpp"
#include "ice/step/variables.hpp"

namespace sluice::ice {

struct PrimitivesInput {
  VariableId rho, momentum, energy;                   // old state
  VariableId velocity, pressure, sound, inverse_rho;  // written

  static PrimitivesInput of(const SchemeVariables&);
};
void add_primitives(TaskList&, const PrimitivesInput&, const SchemeOptions&, int effect);

struct SlopesInput {
  VolumeMotionVariables moving;
  VariableId pressure;
  VariableId mask, open;  // where slopes count: of a redo, beside solids
  VariableId velocity_slope, pressure_slope, predicted_pressure, transverse_velocity;  // written

  static SlopesInput of(const SchemeVariables&);
};
void add_slopes(TaskList&, const SlopesInput&, const SchemeOptions&, int effect);

struct FacesInput {
  VolumeMotionVariables moving;
  VariableId pressure;
  VariableId velocity_slope, pressure_slope, predicted_pressure, transverse_velocity;
  VariableId shock_slope, pi, pure;                        // of a mixture
  std::array<VariableId, 3> face_velocity, face_pressure;  // written

  static FacesInput of(const SchemeVariables&);
};
void add_faces(TaskList&, const FacesInput&, const SchemeOptions&, int effect);

struct ShockShearTaskInput {
  VariableId rho, velocity, pressure, sound;
  VariableId fraction;                               // of solids
  VariableId jumps, jump_marks, shear, shear_marks;  // written

  static ShockShearTaskInput of(const SchemeVariables&);
};
void add_shock_shear(TaskList&, const ShockShearTaskInput&, const SchemeOptions&, int effect);

struct ViscousStressInput {
  VariableId rho, velocity, viscosity, molecular_viscosity;
  std::array<VariableId, 3> stress;  // written

  static ViscousStressInput of(const SchemeVariables&);
};
void add_viscous_stress(TaskList&, const ViscousStressInput&, const SchemeOptions&, int effect);

struct HeatFluxInput {
  VariableId rho, energy, velocity, pressure;
  VariableId viscosity, molecular_viscosity, diffusivity;
  VariableId temperature, conductivity;  // written, but where the turbulence gives k
  std::array<VariableId, 3> heat_flux;   // written

  static HeatFluxInput of(const SchemeVariables&);
};
void add_heat_flux(TaskList&, const HeatFluxInput&, const SchemeOptions&, int effect);

// What acts on the faces of cells in the Lagrangian phase, by axis.
struct FaceVariables {
  std::array<VariableId, 3> velocity, pressure, stress, heat_flux;
};
struct LagrangianInput {
  VariableId rho, inverse_rho, velocity, energy, sound;
  VariableId front_viscosity;
  FaceVariables faces;
  ShockShearInput shear;
  DonorVariables donors;                                // written
  VariableId energy_star, impulse, lagrangian_mixture;  // written

  static LagrangianInput of(const SchemeVariables&);
};
void add_lagrangian(TaskList&, const LagrangianInput&, const SchemeOptions&, int effect);

struct RemapBasesInput {
  VariableId rho, energy, velocity, pressure, inverse_rho, velocity_slope, pressure_slope;
  VariableId mask;
  std::array<VariableId, 3> face_pressure;
  VariableId rho_L, energy_L, velocity_L, energy_scale;
  std::array<VariableId, 3> base;  // written

  static RemapBasesInput of(const SchemeVariables&);
};
void add_remap_bases(TaskList&, const RemapBasesInput&, const SchemeOptions&, int effect);

struct RemapFluxInput {
  VariableId rho, energy, velocity, inverse_rho, mask;
  DonorVariables donors;
  std::array<VariableId, 3> face_velocity, base;
  std::array<VariableId, 3> flux;  // written

  static RemapFluxInput of(const SchemeVariables&);
};
void add_remap_fluxes(TaskList&, const RemapFluxInput&, const SchemeOptions&, int effect);
void add_remap_flux(TaskList&, const RemapFluxInput&, const SchemeOptions&, int effect, int axis);

// What the update of one material and that of a mixture read alike.
struct AmountsInput {
  EndOfStepInput end;
  VariableId rho, momentum, impulse, velocity_L;
  std::array<VariableId, 3> flux;

  static AmountsInput of(const SchemeVariables&);
};
struct UpdateInput {
  AmountsInput amounts;
  VariableId energy_scale;
  // Written: the new state, but where mixing then releases heat.
  VariableId rho, momentum, energy, heat_capacity, closure, source_change;

  static UpdateInput of(const SchemeVariables&);
};
void add_update(TaskList&, const UpdateInput&, const SchemeOptions&, int effect);

}  // namespace sluice::ice
