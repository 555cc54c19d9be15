// What the tasks of one material take of the variables of a step.
#include "ice/one_material/tasks.hpp"

namespace sluice::ice {

PrimitivesInput PrimitivesInput::of(const SchemeVariables& v) {
  return {.rho = v.rho,
          .momentum = v.momentum,
          .energy = v.energy,
          .velocity = v.velocity,
          .pressure = v.pressure,
          .sound = v.sound,
          .inverse_rho = v.inverse_rho};
}

SlopesInput SlopesInput::of(const SchemeVariables& v) {
  return {.moving = v.moving,
          .pressure = v.pressure,
          .mask = v.mask,
          .open = v.walls.open,
          .velocity_slope = v.velocity_slope,
          .pressure_slope = v.pressure_slope,
          .predicted_pressure = v.predicted_pressure,
          .transverse_velocity = v.transverse_velocity};
}

FacesInput FacesInput::of(const SchemeVariables& v) {
  return {.moving = v.moving,
          .pressure = v.pressure,
          .velocity_slope = v.velocity_slope,
          .pressure_slope = v.pressure_slope,
          .predicted_pressure = v.predicted_pressure,
          .transverse_velocity = v.transverse_velocity,
          .shock_slope = v.shock_slope,
          .pi = v.pi,
          .pure = v.pure,
          .face_velocity = v.face_velocity,
          .face_pressure = v.face_pressure};
}

ShockShearTaskInput ShockShearTaskInput::of(const SchemeVariables& v) {
  return {.rho = v.rho,
          .velocity = v.velocity,
          .pressure = v.pressure,
          .sound = v.sound,
          .fraction = v.walls.fraction,
          .jumps = v.jumps,
          .jump_marks = v.jump_marks,
          .shear = v.shear,
          .shear_marks = v.shear_marks};
}

ViscousStressInput ViscousStressInput::of(const SchemeVariables& v) {
  return {.rho = v.rho,
          .velocity = v.velocity,
          .viscosity = v.viscosity,
          .molecular_viscosity = v.molecular_viscosity,
          .stress = v.stress};
}

HeatFluxInput HeatFluxInput::of(const SchemeVariables& v) {
  return {.rho = v.rho,
          .energy = v.energy,
          .velocity = v.velocity,
          .pressure = v.pressure,
          .viscosity = v.viscosity,
          .molecular_viscosity = v.molecular_viscosity,
          .diffusivity = v.scalars.diffusivity,
          .temperature = v.temperature,
          .conductivity = v.conductivity,
          .heat_flux = v.heat_flux};
}

LagrangianInput LagrangianInput::of(const SchemeVariables& v) {
  LagrangianInput in;
  in.rho = v.rho;
  in.inverse_rho = v.inverse_rho;
  in.velocity = v.velocity;
  in.energy = v.energy;
  in.sound = v.sound;
  in.front_viscosity = v.front_viscosity;
  in.faces = {v.face_velocity, v.face_pressure, v.stress, v.heat_flux};
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
  return {.rho = v.rho,
          .energy = v.energy,
          .velocity = v.velocity,
          .inverse_rho = v.inverse_rho,
          .mask = v.mask,
          .donors = DonorVariables::of(v),
          .face_velocity = v.face_velocity,
          .base = v.base,
          .flux = v.flux};
}

AmountsInput AmountsInput::of(const SchemeVariables& v) {
  return {.end = EndOfStepInput::of(v),
          .rho = v.rho,
          .momentum = v.momentum,
          .impulse = v.impulse,
          .velocity_L = v.velocity_L,
          .flux = v.flux};
}

UpdateInput UpdateInput::of(const SchemeVariables& v) {
  return {.amounts = AmountsInput::of(v),
          .energy_scale = v.energy_scale,
          .rho = v.rho_remap,
          .momentum = v.momentum_remap,
          .energy = v.energy_remap,
          .heat_capacity = v.heat_capacity,
          .closure = v.closure,
          .source_change = v.source_change};
}

}  // namespace sluice::ice
