// What the tasks of the classic form take of the variables of a step.
#include "ice/internal_energy_form/variables.hpp"

namespace sluice::ice::internal_energy_form {

FaceVelocityInput FaceVelocityInput::of(const Variables& v) {
  return {.rho = v.common.rho,
          .velocity = v.common.velocity,
          .pressure = v.common.pressure,
          .sound = v.common.sound,
          .face_velocity = v.common.face_velocity};
}

PressureChangeInput PressureChangeInput::of(const Variables& v) {
  return {.energy = v.common.energy,
          .inverse_rho = v.common.inverse_rho,
          .pressure = v.common.pressure,
          .sound = v.common.sound,
          .face_velocity = v.common.face_velocity,
          .pressure_change = v.common.pressure_change,
          .acting_pressure = v.pressure,
          .energy_star = v.common.energy_star};
}

FacePressureInput FacePressureInput::of(const Variables& v) {
  return {.rho = v.common.rho,
          .velocity = v.common.velocity,
          .sound = v.common.sound,
          .pressure = v.pressure,
          .face_pressure = v.common.face_pressure};
}

LagrangianInput LagrangianInput::of(const Variables& v) {
  return {.rho = v.common.rho,
          .inverse_rho = v.common.inverse_rho,
          .old_momentum = v.common.momentum,
          .energy_star = v.common.energy_star,
          .velocity = v.common.velocity,
          .sound = v.common.sound,
          .face_pressure = v.common.face_pressure,
          .stress = v.common.stress,
          .impulse = v.common.impulse,
          .momentum = v.momentum,
          .energy = v.energy};
}

SlopesInput SlopesInput::of(const Variables& v) {
  return {.rho = v.common.rho,
          .mask = v.common.mask,
          .energy = v.energy,
          .momentum = v.momentum,
          .face_velocity = v.common.face_velocity,
          .slope = v.slope,
          .shift = v.shift};
}

FluxesInput FluxesInput::of(const Variables& v) {
  return {.rho = v.common.rho,
          .energy = v.energy,
          .momentum = v.momentum,
          .slope = v.slope,
          .shift = v.shift,
          .face_velocity = v.common.face_velocity,
          .flux = v.common.flux};
}

UpdateInput UpdateInput::of(const Variables& v) {
  return {.rho = v.common.rho,
          .momentum = v.common.momentum,
          .impulse = v.common.impulse,
          .energy_star = v.common.energy_star,
          .sound = v.common.sound,
          .face_velocity = v.common.face_velocity,
          .flux = v.common.flux,
          .rest = v.rest,
          .rho_new = v.common.rho_new,
          .momentum_new = v.common.momentum_new,
          .energy_new = v.common.energy_new,
          .source_change = v.common.source_change};
}

}  // namespace sluice::ice::internal_energy_form
