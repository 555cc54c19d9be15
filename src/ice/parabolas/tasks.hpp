// Tasks of a step of third order: parabolas with characteristic tracing take the place of slopes,
// faces, bases and remap of the default scheme (one_material/tasks.hpp); all other tasks stay.
#pragma once
#include "ice/step/traced_components.hpp"
#include "ice/step/variables.hpp"

namespace sluice::ice {

struct TracedStatesInput {
  VariableId rho, energy, mask;
  VariableId velocity, pressure, sound, inverse_rho;
  std::array<VariableId, 3> traced;  // written

  static TracedStatesInput of(const SchemeVariables&);
};
void add_traced_states(TaskList&, const TracedStatesInput&, const SchemeOptions&, int effect);

struct TracedFluxesInput {
  VariableId rho, energy, velocity, sound;
  std::array<VariableId, 3> traced;
  std::array<VariableId, 3> face_velocity, face_pressure, flux;  // written

  static TracedFluxesInput of(const SchemeVariables&);
};
void add_traced_fluxes(TaskList&, const TracedFluxesInput&, const SchemeOptions&, int effect);

}  // namespace sluice::ice
