// What the tasks of materials with velocities of their own take of the variables of a step.
#include "ice/multi_velocity/tasks.hpp"

namespace sluice::ice::mixture {

RelativeStateInput RelativeStateInput::of(const Variables& v) {
  return {StateOfEach::of(v), v.slip.slip, v.presence, v.cut};
}

SlipMotionInput SlipMotionInput::of(const Variables& v) {
  const SchemeVariables& c = v.common;
  return {RelativeStateInput::of(v),
          {v.slip.lock, v.surface},
          v.pure,
          c.rho,
          c.inverse_rho,
          c.velocity,
          c.sound,
          v.slip.velocity,
          c.moving};
}

SlipStressInput SlipStressInput::of(const Variables& v) {
  return {StateOfEach::of(v), v.pure,          v.slip.velocity, v.common.velocity,
          v.common.viscosity, v.own_viscosity, v.surface,       v.common.stress};
}

SlipPhaseInput SlipPhaseInput::of(const Variables& v) {
  const SchemeVariables& c = v.common;
  const RelativeVelocityVariables& s = v.slip;
  return {RelativeStateInput::of(v),
          {s.lock, v.surface},
          c.lagrangian_mixture,
          c.velocity,
          c.sound,
          c.face_pressure,
          s.stress,
          s.velocity_L,
          s.drift,
          s.kick,
          s.work,
          s.force_work};
}

SlipFacesInput SlipFacesInput::of(const Variables& v) {
  const SchemeVariables& c = v.common;
  return {StateOfEach::of(v), c.moving,   v.pure,    v.cut,           v.slip.drift,
          c.inverse_J,        c.velocity, c.courant, c.face_velocity, v.slip.face_velocity,
          v.slip.outflow};
}

SlipBasesInput SlipBasesInput::of(const Variables& v) {
  const RelativeVelocityVariables& s = v.slip;
  return {v.pure, s.velocity,    v.common.velocity, s.velocity_L,
          s.kick, v.common.mask, v.common.base,     s.base};
}

SlipFluxInput SlipFluxInput::of(const Variables& v) {
  const RelativeVelocityVariables& s = v.slip;
  return {ice::RemapFluxInput::of(v.common),
          DonorsInput::of(v),
          s.velocity,
          s.velocity_L,
          s.outflow,
          s.base,
          s.face_velocity,
          v.flux,
          v.common.material_velocity};
}

SlipUpdateInput SlipUpdateInput::of(const Variables& v) {
  const SchemeVariables& c = v.common;
  return {UpdateInput::of(v), {v.slip.lock, v.surface}, v.slip.velocity_L,
          v.slip.stress,      c.material_velocity,      c.face_pressure};
}

}  // namespace sluice::ice::mixture
