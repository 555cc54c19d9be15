// Tasks of a step of several materials, in order; each in the file of its name, with what it reads
// and writes. `mixture`: what a task of one material (one_material/tasks.hpp) does to the mixture.
#pragma once
#include "ice/mixture/variables.hpp"
#include "ice/one_material/tasks.hpp"

namespace sluice::ice::mixture {

struct PresenceInput {
  MaterialStates state;
  VariableId presence, pure, near, blend, blend_density, blend_energy, alike;  // written

  static PresenceInput of(const Variables&);
};
struct PrimitivesInput {
  PresenceInput materials;
  VariableId momentum;
  VariableId rho, energy, velocity, pressure, sound, inverse_rho, shock_slope, pi;  // written
  VariableId density, specific_energy;  // of each, written for outputs

  static PrimitivesInput of(const Variables&);
};
// `of_each`: density and energy of each material, too, for outputs.
void add_primitives(TaskList&, const PrimitivesInput&, const SchemeOptions&, int effect,
                    bool of_each = false);

// Molecular viscosity of each material.
struct OwnViscosityInput {
  MaterialStates state;
  VariableId presence;
  VariableId own_viscosity;  // written

  static OwnViscosityInput of(const Variables&);
};
void add_own_viscosities(TaskList&, const OwnViscosityInput&, const SchemeOptions&, int effect);
// Viscosity and stress.
struct FrictionInput {
  ViscousStressInput mixture;  // its viscosities are written
  OwnViscosityInput of_each;
  VariableId energy, surface;
  VariableId eddy_viscosity, front_viscosity;  // written

  static FrictionInput of(const Variables&);
};
void add_friction(TaskList&, const FrictionInput&, const SchemeOptions&);

struct HeatFluxInput {
  MaterialStates state;
  VariableId presence, pure, surface, rho, eddy_viscosity;
  VariableId temperature, heat_capacity, conductivity;  // written
  std::array<VariableId, 3> heat_flux, of_materials;    // written

  static HeatFluxInput of(const Variables&);
};
void add_heat_flux(TaskList&, const HeatFluxInput&, const SchemeOptions&, int effect);

struct TransportedHeatInput {
  MaterialStates state;
  VariableId presence, pure, lagrangian_mixture, inverse_rho;
  VariableId viscosity, own_viscosity, eddy_viscosity;
  std::array<VariableId, 3> heat_flux;
  VariableId heat;  // written

  static TransportedHeatInput of(const Variables&);
};
void add_transported_heat(TaskList&, const TransportedHeatInput&, const SchemeOptions&, int effect);

// What the Lagrangian phase does to each material, once that to the mixture is known.
struct LagrangianOfMixture {
  VariableId rho_L, energy_L, energy_star, inverse_J, energy, pressure, inverse_rho;
  VariableId work;
  std::array<VariableId, 3> face_velocity;
  VariableId energy_scale;  // written
};
struct MaterialLagrangianInput {
  MaterialStates state;
  LagrangianOfMixture mixture;
  VariableId presence, pure, near, heat;
  VariableId work;  // with velocities of their own
  VariableId stretch, strain, energy_L, specific_energy_L, energy_scale;  // written

  static MaterialLagrangianInput of(const Variables&);
};
void add_material_lagrangian(TaskList&, const MaterialLagrangianInput&, const SchemeOptions&,
                             int effect);

struct RemapBasesInput {
  ice::RemapBasesInput mixture;
  MaterialStates state;
  VariableId pure, near, blend, blend_density, blend_energy;
  VariableId own_velocity;  // with velocities of their own
  VariableId inverse_J, specific_energy_L, strain, energy_scale;
  std::array<VariableId, 3> base;  // written

  static RemapBasesInput of(const Variables&);
};
void add_remap_bases(TaskList&, const RemapBasesInput&, const SchemeOptions&, int effect);

// What each material of a donor offers to the remap.
struct DonorsInput {
  MaterialStates state;
  VariableId presence, pure, energy_L, specific_energy_L, energy_scale, stretch, strain, alike;
  std::array<VariableId, 3> base;

  static DonorsInput of(const Variables&);
};
struct BlendInput {
  VariableId blend, blend_density, blend_energy;
};
struct RemapFluxInput {
  ice::RemapFluxInput mixture;
  DonorsInput materials;
  BlendInput blend;
  std::array<VariableId, 3> flux;  // written

  static RemapFluxInput of(const Variables&);
};
void add_remap_fluxes(TaskList&, const RemapFluxInput&, const SchemeOptions&, int effect);
void add_remap_flux(TaskList&, const RemapFluxInput&, const SchemeOptions&, int effect, int axis);

// Where solids cut cells: what the update leaves out, and what ends the step there.
struct CutCellsInput {
  VariableId cut, cut_volume, cut_energy, velocity_L, gives_old, fraction, next, old_momentum;
  std::vector<VariableId> energy;
  std::array<VariableId, 3> material_velocity;
  VariableId fraction_new;  // written

  static CutCellsInput of(const Variables&);
};
// What the remap leaves, all written.
struct RemappedState {
  VariableId momentum;
  MaterialStates of_each;
  std::vector<VariableId> slip;
  VariableId source_change, end, pressure, closure;
};
struct UpdateInput {
  AmountsInput amounts;
  VariableId mixture_energy_scale;
  MaterialStates state;
  VariableId stretch, strain, energy_L, pure, surface;
  std::array<VariableId, 3> flux;
  CutCellsInput cut_cells;
  RemappedState next;

  static UpdateInput of(const Variables&);
};
void add_update(TaskList&, const UpdateInput&, const SchemeOptions&, int effect);

struct OnePressureInput {
  EndOfStepInput end;
  VariableId energy_scale, pure, momentum_remap;
  MaterialStates remapped;
  VariableId momentum_new, density_new, new_pressure, closure;  // written
  MaterialStates next;                                          // written

  static OnePressureInput of(const Variables&);
};
void add_one_pressure(TaskList&, const OnePressureInput&, const SchemeOptions&, int effect);

}  // namespace sluice::ice::mixture
