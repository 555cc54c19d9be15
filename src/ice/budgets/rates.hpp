// Rates of a state outside a step: the first step of a run and of a restart.
#pragma once
#include "framework/field/warehouse.hpp"
#include "framework/task/reductions.hpp"
#include "ice/step/variables.hpp"

namespace sluice::ice {

// Is there friction, conduction or a scalar that spreads: any bounds the step.
bool diffusive(const SchemeOptions& options);

// Maxima over the cells of this rank, 1/s, in the places of StepSlots; `options`: of the level of
// the state. Subgrid viscosity counts where ghost cells are there.
void measure_rates(const Warehouse& state, const SchemeOptions& options,
                   const PartReductions& rates);

}  // namespace sluice::ice
