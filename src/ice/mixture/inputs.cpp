// What the tasks of a mixture take of the variables of a step.
#include "ice/mixture/tasks.hpp"

namespace sluice::ice::mixture {

PresenceInput PresenceInput::of(const Variables& v) {
  return {.state = MaterialStates::of(v),
          .presence = v.presence,
          .pure = v.pure,
          .near = v.near,
          .blend = v.blend,
          .blend_density = v.blend_density,
          .blend_energy = v.blend_energy,
          .alike = v.alike};
}

PrimitivesInput PrimitivesInput::of(const Variables& v) {
  const SchemeVariables& c = v.common;
  return {.materials = PresenceInput::of(v),
          .momentum = c.momentum,
          .rho = c.rho,
          .energy = c.energy,
          .velocity = c.velocity,
          .pressure = c.pressure,
          .sound = c.sound,
          .inverse_rho = c.inverse_rho,
          .shock_slope = c.shock_slope,
          .pi = c.pi,
          .density = v.density,
          .specific_energy = v.specific_energy};
}

OwnViscosityInput OwnViscosityInput::of(const Variables& v) {
  return {.state = MaterialStates::of(v), .presence = v.presence, .own_viscosity = v.own_viscosity};
}

FrictionInput FrictionInput::of(const Variables& v) {
  return {.mixture = ViscousStressInput::of(v.common),
          .of_each = OwnViscosityInput::of(v),
          .energy = v.common.energy,
          .surface = v.surface,
          .eddy_viscosity = v.common.eddy_viscosity,
          .front_viscosity = v.common.front_viscosity};
}

HeatFluxInput HeatFluxInput::of(const Variables& v) {
  return {.state = MaterialStates::of(v),
          .presence = v.presence,
          .pure = v.pure,
          .surface = v.surface,
          .rho = v.common.rho,
          .eddy_viscosity = v.common.eddy_viscosity,
          .temperature = v.temperature,
          .heat_capacity = v.heat_capacity,
          .conductivity = v.common.conductivity,
          .heat_flux = v.common.heat_flux,
          .of_materials = v.heat_flux};
}

TransportedHeatInput TransportedHeatInput::of(const Variables& v) {
  const SchemeVariables& c = v.common;
  return {.state = MaterialStates::of(v),
          .presence = v.presence,
          .pure = v.pure,
          .lagrangian_mixture = c.lagrangian_mixture,
          .inverse_rho = c.inverse_rho,
          .viscosity = c.viscosity,
          .own_viscosity = v.own_viscosity,
          .eddy_viscosity = c.eddy_viscosity,
          .heat_flux = v.heat_flux,
          .heat = v.heat};
}

MaterialLagrangianInput MaterialLagrangianInput::of(const Variables& v) {
  const SchemeVariables& c = v.common;
  return {.state = MaterialStates::of(v),
          .mixture = {.rho_L = c.rho_L,
                      .energy_L = c.energy_L,
                      .energy_star = c.energy_star,
                      .inverse_J = c.inverse_J,
                      .energy = c.energy,
                      .pressure = c.pressure,
                      .inverse_rho = c.inverse_rho,
                      .work = c.lagrangian_mixture,
                      .face_velocity = c.face_velocity,
                      .energy_scale = c.energy_scale},
          .presence = v.presence,
          .pure = v.pure,
          .near = v.near,
          .heat = v.heat,
          .work = v.slip.work,
          .stretch = v.stretch,
          .strain = v.strain,
          .energy_L = v.energy_L,
          .specific_energy_L = v.specific_energy_L,
          .energy_scale = v.energy_scale};
}

RemapBasesInput RemapBasesInput::of(const Variables& v) {
  return {.mixture = ice::RemapBasesInput::of(v.common),
          .state = MaterialStates::of(v),
          .pure = v.pure,
          .near = v.near,
          .blend = v.blend,
          .blend_density = v.blend_density,
          .blend_energy = v.blend_energy,
          .own_velocity = v.slip.velocity,
          .inverse_J = v.common.inverse_J,
          .specific_energy_L = v.specific_energy_L,
          .strain = v.strain,
          .energy_scale = v.energy_scale,
          .base = v.base};
}

DonorsInput DonorsInput::of(const Variables& v) {
  return {.state = MaterialStates::of(v),
          .presence = v.presence,
          .pure = v.pure,
          .energy_L = v.energy_L,
          .specific_energy_L = v.specific_energy_L,
          .energy_scale = v.energy_scale,
          .stretch = v.stretch,
          .strain = v.strain,
          .alike = v.alike,
          .base = v.base};
}

RemapFluxInput RemapFluxInput::of(const Variables& v) {
  return {.mixture = ice::RemapFluxInput::of(v.common),
          .materials = DonorsInput::of(v),
          .blend = {v.blend, v.blend_density, v.blend_energy},
          .flux = v.flux};
}

CutCellsInput CutCellsInput::of(const Variables& v) {
  const WallVariables& w = v.common.walls;
  return {.cut = v.cut,
          .cut_volume = v.cut_volume,
          .cut_energy = v.cut_energy,
          .velocity_L = v.common.velocity_L,
          .gives_old = w.gives_old,
          .fraction = w.fraction,
          .next = w.next,
          .old_momentum = v.old_momentum,
          .energy = v.energy,
          .material_velocity = v.common.material_velocity,
          .fraction_new = w.fraction_new};
}

UpdateInput UpdateInput::of(const Variables& v) {
  const SchemeVariables& c = v.common;
  return {.amounts = AmountsInput::of(c),
          .mixture_energy_scale = c.energy_scale,
          .state = MaterialStates::of(v),
          .stretch = v.stretch,
          .strain = v.strain,
          .energy_L = v.energy_L,
          .pure = v.pure,
          .surface = v.surface,
          .flux = v.flux,
          .cut_cells = CutCellsInput::of(v),
          .next = {.momentum = c.momentum_remap,
                   .of_each = {v.mass_remap, v.volume_remap, v.energy_remap},
                   .slip = v.slip.slip_new,
                   .source_change = c.source_change,
                   .end = v.end_remap,
                   .pressure = c.new_pressure,
                   .closure = c.closure}};
}

OnePressureInput OnePressureInput::of(const Variables& v) {
  const SchemeVariables& c = v.common;
  return {.end = EndOfStepInput::of(c),
          .energy_scale = c.energy_scale,
          .pure = v.pure,
          .momentum_remap = c.momentum_remap,
          .remapped = {v.mass_remap, v.volume_remap, v.energy_remap},
          .momentum_new = c.momentum_new,
          .density_new = v.end,
          .new_pressure = c.new_pressure,
          .closure = c.closure,
          .next = {v.mass_new, v.volume_new, v.energy_new}};
}

}  // namespace sluice::ice::mixture
