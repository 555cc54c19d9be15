// The tasks that sum or record what a step does; each is in the file of its name.
#pragma once
#include "ice/budgets/face_flux.hpp"
#include "ice/multi_velocity/tasks.hpp"
#include "ice/step/variables.hpp"

namespace sluice::ice {

// What weight and driving forces do to cells.
struct ForceBudgetInput {
  VariableId rho, momentum, impulse;
};

// What all of these read.
struct BudgetInput {
  FaceFluxInput faces;
  ForceBudgetInput cells;
  VariableId source_change;
  ScalarVariables scalars;

  static BudgetInput of(const SchemeVariables& v) {
    return {.faces = FaceFluxInput::of(v),
            .cells = {v.rho, v.momentum, v.impulse},
            .source_change = v.source_change,
            .scalars = v.scalars};
  }
};

void add_boundary_budget(TaskList&, const FaceFluxInput&, const SchemeOptions&, int effect);
void add_gravity_budget(TaskList&, const ForceBudgetInput&, const SchemeOptions&, int effect);
void add_volume_budget(TaskList&, const BudgetInput&, const SchemeOptions&, int effect);
void add_flux_record(TaskList&, const BudgetInput&, const SchemeOptions&, int effect);

}  // namespace sluice::ice

namespace sluice::ice::mixture {

// The work of a driving force on relative velocities, summed; absent without one.
void add_relative_velocity_force_budget(TaskList&, VariableId force_work, const SchemeOptions&,
                                        int effect);

}  // namespace sluice::ice::mixture
