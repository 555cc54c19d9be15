// What the tasks of a mixture take of the variables of a step.
#include "ice/mixture/tasks.hpp"

namespace sluice::ice::mixture {

PresenceInput PresenceInput::of(const Variables& v) {
  return {StateOfEach::of(v), v.presence,     v.pure, v.near, v.blend,
          v.blend_density,    v.blend_energy, v.alike};
}

PrimitivesInput PrimitivesInput::of(const Variables& v) {
  const SchemeVariables& c = v.common;
  return {PresenceInput::of(v), c.momentum, c.rho,     c.energy,
          c.velocity,           c.pressure, c.sound,   c.inverse_rho,
          c.shock_slope,        c.pi,       v.density, v.specific_energy};
}

OwnViscosityInput OwnViscosityInput::of(const Variables& v) {
  return {StateOfEach::of(v), v.presence, v.own_viscosity};
}

FrictionInput FrictionInput::of(const Variables& v) {
  return {ViscousStressInput::of(v.common), OwnViscosityInput::of(v), v.common.energy, v.surface,
          v.common.eddy_viscosity,          v.common.front_viscosity};
}

HeatFluxInput HeatFluxInput::of(const Variables& v) {
  return {StateOfEach::of(v), v.presence,      v.pure,
          v.surface,          v.common.rho,    v.common.eddy_viscosity,
          v.temperature,      v.heat_capacity, v.common.conductivity,
          v.common.heat_flux, v.heat_flux};
}

TransportedHeatInput TransportedHeatInput::of(const Variables& v) {
  const SchemeVariables& c = v.common;
  return {StateOfEach::of(v), v.presence,  v.pure,          c.lagrangian_mixture,
          c.inverse_rho,      c.viscosity, v.own_viscosity, c.eddy_viscosity,
          v.heat_flux,        v.heat};
}

LagrangianOfEachInput LagrangianOfEachInput::of(const Variables& v) {
  const SchemeVariables& c = v.common;
  return {StateOfEach::of(v),
          {c.rho_L, c.energy_L, c.energy_star, c.inverse_J, c.energy, c.pressure, c.inverse_rho,
           c.lagrangian_mixture, c.face_velocity, c.energy_scale},
          v.presence,
          v.pure,
          v.near,
          v.heat,
          v.slip.work,
          v.stretch,
          v.strain,
          v.energy_L,
          v.specific_energy_L,
          v.energy_scale};
}

RemapBasesInput RemapBasesInput::of(const Variables& v) {
  return {ice::RemapBasesInput::of(v.common),
          StateOfEach::of(v),
          v.pure,
          v.near,
          v.blend,
          v.blend_density,
          v.blend_energy,
          v.slip.velocity,
          v.common.inverse_J,
          v.specific_energy_L,
          v.strain,
          v.energy_scale,
          v.base};
}

DonorsInput DonorsInput::of(const Variables& v) {
  return {StateOfEach::of(v), v.presence, v.pure,   v.energy_L, v.specific_energy_L,
          v.energy_scale,     v.stretch,  v.strain, v.alike,    v.base};
}

RemapFluxInput RemapFluxInput::of(const Variables& v) {
  return {ice::RemapFluxInput::of(v.common),
          DonorsInput::of(v),
          {v.blend, v.blend_density, v.blend_energy},
          v.flux};
}

CutCellsInput CutCellsInput::of(const Variables& v) {
  const WallVariables& w = v.common.walls;
  return {
      v.cut,  v.cut_volume,   v.cut_energy, v.common.velocity_L,        w.gives_old,   w.fraction,
      w.next, v.old_momentum, v.energy,     v.common.material_velocity, w.fraction_new};
}

UpdateInput UpdateInput::of(const Variables& v) {
  const SchemeVariables& c = v.common;
  return {AmountsInput::of(c),
          c.energy_scale,
          StateOfEach::of(v),
          v.stretch,
          v.strain,
          v.energy_L,
          v.pure,
          v.surface,
          v.flux,
          CutCellsInput::of(v),
          {c.momentum_remap,
           {v.mass_remap, v.volume_remap, v.energy_remap},
           v.slip.slip_new,
           c.source_change,
           v.end_remap,
           c.new_pressure,
           c.closure}};
}

OnePressureInput OnePressureInput::of(const Variables& v) {
  const SchemeVariables& c = v.common;
  return {EndOfStepInput::of(c),
          c.energy_scale,
          v.pure,
          c.momentum_remap,
          {v.mass_remap, v.volume_remap, v.energy_remap},
          c.momentum_new,
          v.end,
          c.new_pressure,
          c.closure,
          {v.mass_new, v.volume_new, v.energy_new}};
}

}  // namespace sluice::ice::mixture
