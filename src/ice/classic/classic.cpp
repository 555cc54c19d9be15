// The classic ICE step as a table of tasks.
#include "ice/classic/classic.hpp"

#include <cmath>
#include <string>

#include "ice/classic/variables.hpp"
#include "ice/ice.hpp"
#include "ice/labels.hpp"

namespace sluice::ice {
namespace {

classic::Variables declare_variables(TaskList& list, const SchemeOptions& o) {
  const Labels& l = labels();
  const int C = o.components, D = o.axes.count;
  classic::Variables v;
  SchemeVariables& s = v.common;
  s.rho = list.old_state(l.mass, 0, 1);
  s.momentum = list.old_state(l.momentum, 0, C);
  s.energy = list.old_state(l.energy, 0, 1);
  if (o.masked) s.mask = list.old_state(l.mask, 0, 1);
  s.rho_new = list.new_state(l.mass, 0, 1);
  s.momentum_new = list.new_state(l.momentum, 0, C);
  s.energy_new = list.new_state(l.energy, 0, 1);
  s.velocity = list.temporary("velocity", C);
  s.pressure = list.temporary("pressure at the start");
  s.sound = list.temporary("sound speed");
  s.inverse_rho = list.temporary("1/rho");
  s.pressure_change = list.temporary("pressure change");
  s.energy_star = list.temporary("energy after work");
  s.impulse = list.temporary("impulse", C);
  for (int a = 0; a < D; ++a) {
    const auto n = static_cast<std::size_t>(a);
    const int d = o.axes.direction[a];
    const std::string axis = " of axis " + std::to_string(a);
    s.face_velocity[n] = list.temporary("face velocity" + axis, 1, d);
    s.face_pressure[n] = list.temporary("face pressure" + axis, 1, d);
    s.stress[n] = list.temporary("stress" + axis, C, d);
    s.flux[n] = list.temporary("flux" + axis, 2 + C, d);
  }
  v.pressure = list.temporary("pressure");
  v.energy = list.temporary("advected energy");
  v.momentum = list.temporary("advected momentum", C);
  v.slope = list.temporary("limited slopes", (2 + C) * D);
  v.shift = list.temporary("centroid shift", D);
  v.rest = list.temporary("share that stays");
  return v;
}

}  // namespace

// Each line is a task (one for each axis where it says "face" or "fluxes"), in the file of its name
// under classic/ or, without "classic::", under conservative/.
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
  declare_step_outputs(list, s, o);  // whatever a deck saves                      outputs
}

int classic_ghost_layers(const SchemeOptions& o) {
  return classic::ghost_layers(o);
}

double classic_sound_share(int axes) {
  constexpr double margin = 0.98;
  return margin / std::sqrt(2.0 * axes);
}

}  // namespace sluice::ice
