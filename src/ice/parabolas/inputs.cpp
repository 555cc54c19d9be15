// What the tasks of the third order take of the variables of a step.
#include "ice/parabolas/tasks.hpp"

namespace sluice::ice {

TracedStatesInput TracedStatesInput::of(const SchemeVariables& v) {
  return {.rho = v.rho,
          .energy = v.energy,
          .mask = v.mask,
          .velocity = v.velocity,
          .pressure = v.pressure,
          .sound = v.sound,
          .inverse_rho = v.inverse_rho,
          .traced = v.traced};
}

TracedFluxesInput TracedFluxesInput::of(const SchemeVariables& v) {
  return {.rho = v.rho,
          .energy = v.energy,
          .velocity = v.velocity,
          .sound = v.sound,
          .traced = v.traced,
          .face_velocity = v.face_velocity,
          .face_pressure = v.face_pressure,
          .flux = v.flux};
}

}  // namespace sluice::ice
