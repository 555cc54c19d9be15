// The time steps of ICE, each readable as a table of tasks.
#pragma once
#include "framework/task/effect.hpp"
#include "framework/task/task.hpp"
#include "ice/step/variables.hpp"

namespace sluice::ice {

// `options`: of the graph; `effects`: of the scene.
void declare_one_material(TaskList& list, const SchemeOptions& options, const EffectList& effects);
// Of blocks that solids meet; one fluid.
void declare_cut_material(TaskList& list, const SchemeOptions& options, const EffectList& effects);
// Likewise of several fluids.
void declare_cut_mixture(TaskList& list, const SchemeOptions& options, const EffectList& effects);
void declare_mixture(TaskList& list, const SchemeOptions& options, const EffectList& effects);
// A mixture whose materials each have a velocity.
void declare_multi_velocity(TaskList& list, const SchemeOptions& options,
                            const EffectList& effects);
void declare_internal_energy_form(TaskList& list, const SchemeOptions& options,
                                  const EffectList& effects);

}  // namespace sluice::ice
