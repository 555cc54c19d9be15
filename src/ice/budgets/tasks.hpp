// The tasks that sum or record what a step does; each is in the file of its name.
#pragma once
#include "ice/multi_velocity/tasks.hpp"
#include "ice/step/variables.hpp"

namespace sluice::ice {

void add_boundary_budget(TaskList&, const SchemeVariables&, const SchemeOptions&, int effect);
void add_gravity_budget(TaskList&, const SchemeVariables&, const SchemeOptions&, int effect);
void add_volume_budget(TaskList&, const SchemeVariables&, const SchemeOptions&, int effect);
void add_flux_record(TaskList&, const SchemeVariables&, const SchemeOptions&, int effect);

}  // namespace sluice::ice

namespace sluice::ice::mixture {

// The work of a driving force on relative velocities, summed; absent without one.
void add_relative_velocity_force_budget(TaskList&, const Variables&, const SchemeOptions&,
                                        int effect);

}  // namespace sluice::ice::mixture
