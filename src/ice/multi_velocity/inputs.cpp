// What the tasks of materials with velocities of their own take of the variables of a step.
#include "ice/multi_velocity/tasks.hpp"

namespace sluice::ice::mixture {

RelativeStateInput RelativeStateInput::of(const Variables& v) {
  return {
      .state = MaterialStates::of(v), .slip = v.slip.slip, .presence = v.presence, .cut = v.cut};
}

SlipMotionInput SlipMotionInput::of(const Variables& v) {
  const SchemeVariables& c = v.common;
  return {.state = RelativeStateInput::of(v),
          .bonds = {v.slip.lock, v.surface},
          .pure = v.pure,
          .rho = c.rho,
          .inverse_rho = c.inverse_rho,
          .velocity = c.velocity,
          .sound = c.sound,
          .own_velocity = v.slip.velocity,
          .moving = c.moving};
}

SlipStressInput SlipStressInput::of(const Variables& v) {
  return {.state = MaterialStates::of(v),
          .pure = v.pure,
          .own_velocity = v.slip.velocity,
          .velocity = v.common.velocity,
          .viscosity = v.common.viscosity,
          .own_viscosity = v.own_viscosity,
          .surface = v.surface,
          .stress = v.common.stress};
}

SlipPhaseInput SlipPhaseInput::of(const Variables& v) {
  const SchemeVariables& c = v.common;
  const RelativeVelocityVariables& s = v.slip;
  return {.state = RelativeStateInput::of(v),
          .bonds = {s.lock, v.surface},
          .lagrangian_mixture = c.lagrangian_mixture,
          .velocity = c.velocity,
          .sound = c.sound,
          .face_pressure = c.face_pressure,
          .stress = s.stress,
          .velocity_L = s.velocity_L,
          .drift = s.drift,
          .kick = s.kick,
          .work = s.work,
          .force_work = s.force_work};
}

SlipFacesInput SlipFacesInput::of(const Variables& v) {
  const SchemeVariables& c = v.common;
  return {.state = MaterialStates::of(v),
          .moving = c.moving,
          .pure = v.pure,
          .cut = v.cut,
          .drift = v.slip.drift,
          .inverse_J = c.inverse_J,
          .velocity = c.velocity,
          .courant = c.courant,
          .face_velocity = c.face_velocity,
          .own_face_velocity = v.slip.face_velocity,
          .outflow = v.slip.outflow};
}

SlipBasesInput SlipBasesInput::of(const Variables& v) {
  const RelativeVelocityVariables& s = v.slip;
  return {.pure = v.pure,
          .own_velocity = s.velocity,
          .velocity = v.common.velocity,
          .velocity_L = s.velocity_L,
          .kick = s.kick,
          .mask = v.common.mask,
          .mixture_base = v.common.base,
          .base = s.base};
}

SlipFluxInput SlipFluxInput::of(const Variables& v) {
  const RelativeVelocityVariables& s = v.slip;
  return {.mixture = ice::RemapFluxInput::of(v.common),
          .materials = DonorsInput::of(v),
          .velocity = s.velocity,
          .velocity_L = s.velocity_L,
          .outflow = s.outflow,
          .base = s.base,
          .face_velocity = s.face_velocity,
          .flux = v.flux,
          .material_velocity = v.common.material_velocity};
}

SlipUpdateInput SlipUpdateInput::of(const Variables& v) {
  const SchemeVariables& c = v.common;
  return {.update = UpdateInput::of(v),
          .bonds = {v.slip.lock, v.surface},
          .velocity_L = v.slip.velocity_L,
          .stress = v.slip.stress,
          .material_velocity = c.material_velocity,
          .face_pressure = c.face_pressure};
}

}  // namespace sluice::ice::mixture
