// The classic ICE step as a table of tasks.
#include "ice/classic/classic.hpp"

#include "ice/classic/variables.hpp"
#include "ice/saved/step_labels.hpp"
#include "ice/sources/source_tasks.hpp"
#include "ice/step/effect_ids.hpp"

namespace sluice::ice {
namespace {

classic::Variables declare_variables(TaskList& list, const SchemeOptions& o) {
  const int C = o.components, D = o.axes.count;
  classic::Variables v;
  v.common = declare_common_variables(list, o);
  v.common.pressure_change = list.temporary("pressure change");
  v.pressure = list.temporary("pressure after its change");
  v.energy = list.temporary("advected energy");
  v.momentum = list.temporary("advected momentum", C);
  v.slope = list.temporary("limited slopes", (2 + C) * D);
  v.shift = list.temporary("centroid shift", D);
  v.rest = list.temporary("share that stays");
  return v;
}

}  // namespace

// Each line is a task (one for each axis where it says "face" or "fluxes"), in the file of its name
// under classic/ or, without "classic::", under one_material/.
void declare_classic(TaskList& list, const SchemeOptions& o, const EffectList& effects) {
  const classic::Variables v = declare_variables(list, o);
  const SchemeVariables& s = v.common;
  // task                             reads                        writes
  add_primitives(list, s, o, effect_flow);                // state                 u, p_n, c
  classic::add_face_velocity(list, v, o, effect_flow);    // rho, u, p_n           u_f
  classic::add_pressure_change(list, v, o, effect_flow);  // u_f, p_n, c, E        dp, p, E*
  classic::add_face_pressure(list, v, o, effect_flow);    // rho, p                p_f
  add_viscous_stress(list, s, o, effect_viscosity);       // u                     t_f
  classic::add_lagrangian(list, v, o, effect_flow);       // m, p_f, t_f, E*       m_L, E_L
  classic::add_slopes(list, v, o, effect_second_order);   // rho, m_L, E_L, u_f    slopes
  classic::add_fluxes(list, v, o, effect_flow);           // u_f, m_L, E_L, slopes F
  classic::add_update(list, v, o, effect_flow);           // m_L, E*, F            new state, rates
  if (effects.on(effect_boundary_account))
    add_boundary_account(list, s, o, effect_boundary_account);  // F, p_f          sums
  add_gravity_account(list, s, o, effect_of_forces(o));         // m, dp                       sums
  add_source_account(list, s, o, effect_sources);               // change          sums
  add_volume_account(list, s, o, effect_diagnostics);           // F, p_f          sums
  add_flux_record(list, s, o, effect_flux_record);  // F, p_f                      face tables
  declare_step_outputs(list, s, o, material_alone(list, s, o));  // saved         outputs
}

}  // namespace sluice::ice
