// The time steps of ICE, each readable as a table of tasks.
#pragma once
#include "framework/task/effect.hpp"
#include "framework/task/task.hpp"
#include "ice/step/variables.hpp"

namespace sluice::ice {

// `options`: of the graph; `effects`: of the scene.
// Of blocks that are full of fluid, of one material or several.
void declare_step_of_full_cells(TaskList& list, const SchemeOptions& options,
                                const EffectList& effects);
// Of blocks with cells that solids cut.
void declare_step_of_cut_cells(TaskList& list, const SchemeOptions& options,
                               const EffectList& effects);
// The classic form, of one material.
void declare_step_of_internal_energy(TaskList& list, const SchemeOptions& options,
                                     const EffectList& effects);

}  // namespace sluice::ice
