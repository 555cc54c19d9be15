// Declaring the variables of a step.
#include "ice/step/variables.hpp"

#include <string>

#include "ice/fluid/labels.hpp"
#include "ice/step/source_change.hpp"
#include "ice/step/traced_components.hpp"

namespace sluice::ice {

void declare_step_temporaries(TaskList& list, const SchemeOptions& o, SchemeVariables& v) {
  const int C = o.grid.components;
  v.velocity = list.temporary("velocity", C);
  v.pressure = list.temporary("pressure");
  v.sound = list.temporary("sound speed");
  v.inverse_rho = list.temporary("1/rho");
  for (int a = 0; a < o.grid.axes.count; ++a) {
    const int d = o.grid.axes.direction[a];
    const std::string axis = " of axis " + std::to_string(a);
    v.face_velocity[a] = list.temporary("face velocity" + axis, 1, d);
    v.face_pressure[a] = list.temporary("face pressure" + axis, 1, d);
    v.stress[a] = list.temporary("stress" + axis, C, d);
    if (o.transport.conducting) v.heat_flux[a] = list.temporary("heat flux" + axis, 1, d);
    v.flux[a] = list.temporary("flux" + axis, 2 + C, d);
  }
  if (o.scheme.shears_shocks) {
    v.jumps = list.temporary("jumps of pressure", 2 * o.grid.axes.count);
    v.jump_marks = list.temporary("where pressure jumps");
    v.shear = list.temporary("shear along shocks", o.grid.axes.count);
    v.shear_marks = list.temporary("where shocks are sheared");
  }
  if (o.transport.conducting) v.temperature = list.temporary("temperature");
  if (o.transport.viscosity_varies) v.viscosity = list.temporary("dynamic viscosity");
  if (o.transport.models.turbulence) {
    v.eddy_viscosity = list.temporary("eddy viscosity");
    if (o.molecular_varies()) v.molecular_viscosity = list.temporary("molecular viscosity");
  }
  const auto conductors = o.materials.mixture ? static_cast<int>(o.materials.fluids.size()) : 1;
  if (o.transport.conductivity_varies)
    v.conductivity = list.temporary("thermal conductivity", conductors);
  v.moving = {v.rho, v.inverse_rho, v.velocity, v.sound};
  v.energy_star = list.temporary("energy after work");
  v.impulse = list.temporary("impulse", C);
  if (o.forces.sources != nullptr)
    v.source_change = list.temporary("change by sources", source_change(o).count());
}

SchemeVariables declare_common_variables(TaskList& list, const SchemeOptions& o) {
  const Labels& l = labels();
  const int C = o.grid.components;
  SchemeVariables v;
  v.rho = list.old_state(l.mass, o.materials.index, 1);
  v.momentum = list.old_state(l.momentum, 0, C);
  v.energy = list.old_state(l.energy, o.materials.index, 1);
  if (o.scheme.masked) v.mask = list.old_state(l.mask, 0, 1);
  v.rho_new = list.new_state(l.mass, o.materials.index, 1);
  v.momentum_new = list.new_state(l.momentum, 0, C);
  v.energy_new = list.new_state(l.energy, o.materials.index, 1);
  v.after = {v.rho_new, v.momentum_new, v.energy_new};
  v.rho_remap = o.materials.releases_heat ? list.temporary("mass after the remap") : v.rho_new;
  v.momentum_remap =
      o.materials.releases_heat ? list.temporary("momentum after the remap", C) : v.momentum_new;
  v.energy_remap =
      o.materials.releases_heat ? list.temporary("energy after the remap") : v.energy_new;
  declare_step_temporaries(list, o, v);
  return v;
}

void declare_conservative_temporaries(TaskList& list, const SchemeOptions& o, SchemeVariables& v) {
  const int C = o.grid.components, D = o.grid.axes.count;
  v.velocity_slope = list.temporary("velocity slope", D);
  v.pressure_slope = list.temporary("pressure slope", D);
  v.predicted_pressure = list.temporary("predicted pressure");
  v.transverse_velocity = list.temporary("transverse advection", D);
  for (int a = 0; a < D; ++a)
    v.base[a] = list.temporary("remap base of axis " + std::to_string(a), 2 + C);
  v.inverse_J = list.temporary("1/J");
  v.rho_L = list.temporary("Lagrangian density");
  v.energy_L = list.temporary("Lagrangian energy");
  v.velocity_L = list.temporary("Lagrangian velocity", C);
  v.courant = list.temporary("outflow Courant number");
  v.inverse_courant = list.temporary("1/outflow Courant number");
}

SchemeVariables declare_conservative_variables(TaskList& list, const SchemeOptions& o) {
  SchemeVariables v = declare_common_variables(list, o);
  declare_conservative_temporaries(list, o, v);
  if (o.scheme.third_order)
    for (int a = 0; a < o.grid.axes.count; ++a)
      v.traced[a] = list.temporary("traced states of axis " + std::to_string(a),
                                   2 * TracedComponents::of(o).count());
  if (o.materials.fluid.gamma_law() == nullptr) {
    if (!o.scheme.third_order) v.energy_scale = list.temporary("energy scale");
    v.closure = list.temporary("closure of the new state", 3);
  }
  if (o.transport.conducting) v.heat_capacity = list.temporary("heat capacity of the new state");
  return v;
}

}  // namespace sluice::ice
