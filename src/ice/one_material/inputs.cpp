// What the tasks of one material take of the variables of a step.
#include "ice/one_material/tasks.hpp"

namespace sluice::ice {

PrimitivesInput PrimitivesInput::of(const SchemeVariables& v) {
  return {v.rho, v.momentum, v.energy, v.velocity, v.pressure, v.sound, v.inverse_rho};
}

SlopesInput SlopesInput::of(const SchemeVariables& v) {
  return {v.moving,
          v.pressure,
          v.mask,
          v.walls.open,
          v.velocity_slope,
          v.pressure_slope,
          v.predicted_pressure,
          v.transverse_velocity};
}

FacesInput FacesInput::of(const SchemeVariables& v) {
  return {v.moving,
          v.pressure,
          v.velocity_slope,
          v.pressure_slope,
          v.predicted_pressure,
          v.transverse_velocity,
          v.shock_slope,
          v.pi,
          v.pure,
          v.face_velocity,
          v.face_pressure};
}

ShockShearTaskInput ShockShearTaskInput::of(const SchemeVariables& v) {
  return {v.rho,   v.velocity,   v.pressure, v.sound,      v.walls.fraction,
          v.jumps, v.jump_marks, v.shear,    v.shear_marks};
}

ViscousStressInput ViscousStressInput::of(const SchemeVariables& v) {
  return {v.rho, v.velocity, v.viscosity, v.molecular_viscosity, v.stress};
}

HeatFluxInput HeatFluxInput::of(const SchemeVariables& v) {
  return {v.rho,
          v.energy,
          v.velocity,
          v.pressure,
          v.viscosity,
          v.molecular_viscosity,
          v.scalars.diffusivity,
          v.temperature,
          v.conductivity,
          v.heat_flux};
}

LagrangianInput LagrangianInput::of(const SchemeVariables& v) {
  LagrangianInput in;
  in.rho = v.rho;
  in.inverse_rho = v.inverse_rho;
  in.velocity = v.velocity;
  in.energy = v.energy;
  in.sound = v.sound;
  in.front_viscosity = v.front_viscosity;
  in.face_velocity = v.face_velocity;
  in.face_pressure = v.face_pressure;
  in.stress = v.stress;
  in.heat_flux = v.heat_flux;
  in.shear = ShockShearInput::of(v);
  in.donors = DonorVariables::of(v);
  in.energy_star = v.energy_star;
  in.impulse = v.impulse;
  in.lagrangian_mixture = v.lagrangian_mixture;
  return in;
}

RemapBasesInput RemapBasesInput::of(const SchemeVariables& v) {
  RemapBasesInput in;
  in.rho = v.rho;
  in.energy = v.energy;
  in.velocity = v.velocity;
  in.pressure = v.pressure;
  in.inverse_rho = v.inverse_rho;
  in.velocity_slope = v.velocity_slope;
  in.pressure_slope = v.pressure_slope;
  in.mask = v.mask;
  in.face_pressure = v.face_pressure;
  in.rho_L = v.rho_L;
  in.energy_L = v.energy_L;
  in.velocity_L = v.velocity_L;
  in.energy_scale = v.energy_scale;
  in.base = v.base;
  return in;
}

RemapFluxInput RemapFluxInput::of(const SchemeVariables& v) {
  return {v.rho,           v.energy, v.velocity, v.inverse_rho, v.mask, DonorVariables::of(v),
          v.face_velocity, v.base,   v.flux};
}

AmountsInput AmountsInput::of(const SchemeVariables& v) {
  return {EndOfStepInput::of(v), v.rho, v.momentum, v.impulse, v.velocity_L, v.flux};
}

UpdateInput UpdateInput::of(const SchemeVariables& v) {
  return {AmountsInput::of(v), v.energy_scale,  v.rho_remap, v.momentum_remap,
          v.energy_remap,      v.heat_capacity, v.closure,   v.source_change};
}

}  // namespace sluice::ice
