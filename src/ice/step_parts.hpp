// What the tables of tasks have in common: rows, variables, and tasks that several rows share.
#pragma once
#include <type_traits>

#include "framework/task/effect.hpp"
#include "ice/budgets/tasks.hpp"
#include "ice/cut_cells/materials.hpp"
#include "ice/internal_energy_form/variables.hpp"
#include "ice/mixture/tasks.hpp"
#include "ice/outputs/step_labels.hpp"
#include "ice/scalars/variables.hpp"
#include "ice/transport/viscosity.hpp"

namespace sluice::ice {

// A row of a step: a task that is there where the first column says so. It takes its input, or the
// variables of the step from which that follows.
struct Rows {
  TaskList& list;
  const SchemeOptions& o;

  template <class Input, class From>
  void operator()(bool when, void (*add)(TaskList&, const Input&, const SchemeOptions&, int),
                  const From& v, int effect) const {
    if (!when) return;
    if constexpr (std::is_same_v<Input, From>)
      add(list, v, o, effect);
    else
      add(list, Input::of(v), o, effect);
  }
};

internal_energy_form::Variables declare_classic_variables(TaskList& list, const SchemeOptions& o);
// `apart`: several materials with a velocity each.
mixture::Variables declare_full_cells(TaskList& list, const SchemeOptions& o, bool apart);
// `x`: what several materials need in addition.
mixture::Variables declare_cut_cells(TaskList& list, const SchemeOptions& o, bool apart,
                                     cut_cells::MaterialVariables& x);

// Velocity and pressure of the faces: from Riemann problems, or from a pressure that is solved for.
void add_face_states(TaskList& list, const SchemeVariables& v, const SchemeOptions& o);
// The same of faces between cells of fluid alone, where solids cut some.
void add_fluid_faces(TaskList& list, const SchemeVariables& v, const SchemeOptions& o);

void add_mixture_primitives(TaskList& list, const mixture::PrimitivesInput& in,
                            const SchemeOptions& o, int effect);
void add_transport_models(TaskList& list, const TransportInput& in, const SchemeOptions& o,
                          int effect);
void add_mixture_friction(TaskList& list, const mixture::FrictionInput& in, const SchemeOptions& o,
                          int effect);
// Of materials that move apart: the stress of the mixture and of each follow here.
void add_material_stress(TaskList& list, mixture::Variables& m, const SchemeOptions& o, int effect);
// Of a semi-implicit step: the error of the volume that is left.
void add_end_of_solve(TaskList& list, const mixture::Variables& m, const SchemeOptions& o);
// Scalars of materials that move apart.
void add_material_scalars(TaskList& list, const mixture::Variables& m,
                          const scalars::FlowOfScalars& of_mixture, const SchemeOptions& o);
// What leaves through sides and levels, and what forces and models add: all steps alike.
void add_budgets(TaskList& list, const BudgetInput& v, const SchemeOptions& o,
                 const EffectList& effects);
void add_slip_budget(TaskList& list, const mixture::Variables& m, const SchemeOptions& o,
                     int effect);
void add_outputs(TaskList& list, const mixture::Variables& m, const SchemeOptions& o);

}  // namespace sluice::ice
