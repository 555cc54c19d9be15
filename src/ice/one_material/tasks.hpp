// Tasks of a step of one material in the default scheme, in order; each in the file of its name.
#pragma once
#include "ice/step/variables.hpp"

namespace sluice::ice {

void add_primitives(TaskList&, const SchemeVariables&, const SchemeOptions&, int effect);
void add_slopes(TaskList&, const SchemeVariables&, const SchemeOptions&, int effect);
void add_faces(TaskList&, const SchemeVariables&, const SchemeOptions&, int effect);
void add_shock_shear(TaskList&, const SchemeVariables&, const SchemeOptions&, int effect);
void add_viscous_stress(TaskList&, const SchemeVariables&, const SchemeOptions&, int effect);
void add_heat_flux(TaskList&, const SchemeVariables&, const SchemeOptions&, int effect);
void add_lagrangian(TaskList&, const SchemeVariables&, const SchemeOptions&, int effect);
void add_remap_bases(TaskList&, const SchemeVariables&, const SchemeOptions&, int effect);
void add_remap_fluxes(TaskList&, const SchemeVariables&, const SchemeOptions&, int effect);
void add_remap_flux(TaskList&, const SchemeVariables&, const SchemeOptions&, int effect, int axis);
void add_update(TaskList&, const SchemeVariables&, const SchemeOptions&, int effect);

}  // namespace sluice::ice
