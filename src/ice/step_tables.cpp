#include "ice/step_tables.hpp"

#include "ice/account/tasks.hpp"
#include "ice/classic/variables.hpp"
#include "ice/mixture/slip.hpp"
#include "ice/mixture/surface.hpp"
#include "ice/one_material/tasks.hpp"
#include "ice/pressure/variables.hpp"
#include "ice/saved/materials_of_mixture.hpp"
#include "ice/saved/step_labels.hpp"
#include "ice/scalars/heat_release.hpp"
#include "ice/scalars/reactions.hpp"
#include "ice/scalars/variables.hpp"
#include "ice/sources/source_tasks.hpp"
#include "ice/step/effect_ids.hpp"
#include "ice/transport/viscosity.hpp"
#include "ice/walls/materials.hpp"
#include "ice/walls/variables.hpp"

namespace sluice::ice {
namespace {

internal_energy_form::Variables declare_classic_variables(TaskList& list, const SchemeOptions& o) {
  const int C = o.components, D = o.axes.count;
  internal_energy_form::Variables v;
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

// Velocity and pressure of the faces: from Riemann problems, or from a pressure that is solved for.
void add_face_states(TaskList& list, const SchemeVariables& v, const SchemeOptions& o) {
  if (o.implicit) return pressure::add_solved_faces(list, v, o, effect_pressure_solve);
  add_slopes(list, v, o, effect_second_order);
  add_faces(list, v, o, effect_flow);
}

// Steps 7 and 8 of donors beside solids.
void add_bases_and_fluxes(TaskList& list, const SchemeVariables& v, const SchemeOptions& o) {
  SchemeOptions masked = o;
  masked.masked = true;  // weights of slopes take the place of the mask of a redone step
  add_remap_bases(list, walls::base_variables(v), masked, effect_second_order);
  for (int axis = 0; axis < o.axes.count; ++axis)
    add_remap_flux(list, walls::remap_variables(v, axis), masked, effect_flow, axis);
}

// What leaves through sides and levels, and what forces and models add: all steps alike.
void add_accounts(TaskList& list, const SchemeVariables& v, const SchemeOptions& o,
                  const EffectList& effects) {
  if (effects.on(effect_boundary_budget))
    add_boundary_budget(list, v, o, effect_boundary_budget);  // fluxes         sums
  add_gravity_budget(list, v, o, effect_of_forces(o));        // m, dp          sums
  add_source_budget(list, v, o, effect_sources);              // change         sums
  add_volume_budget(list, v, o, effect_diagnostics);          // fluxes, m, dp  sums
  add_flux_record(list, v, o, effect_flux_record);            // fluxes         face tables
}

}  // namespace

// One conservative step. Each line is a task (one for each axis where it says "faces" or "remap"),
// in the file of its name under one_material/; when it is absent is said there in its first line.
void declare_one_material(TaskList& list, const SchemeOptions& o, const EffectList& effects) {
  SchemeVariables v = declare_conservative_variables(list, o);
  if (o.implicit) pressure::declare_variables(list, o, v);
  scalars::declare_variables(list, o, v, {std::span(&v.rho, 1), std::span(&v.rho_remap, 1), {}});
  // task                    reads                              writes
  add_primitives(list, v, o, effect_flow);          // state                    u, p, c
  add_face_states(list, v, o);                      // u, p, c                  slopes, u_f, p_f
  add_shock_shear(list, v, o, effect_shock_shear);  // rho, u, p, c     k of faces along shocks
  add_transport(list, v, o, effect_viscosity, effect_turbulence);  // rho, E, u  mu, k of cells
  add_viscous_stress(list, v, o, effect_viscosity);                // u                        t_f
  add_heat_flux(list, v, o, effect_conduction);      // rho, E                   T, q_f
  add_lagrangian(list, v, o, effect_flow);           // state, u_f, p_f, t_f, q  rho_L, E_L, v, E*
  add_remap_bases(list, v, o, effect_second_order);  // state, slopes, Lagrange  bases
  add_remap_fluxes(list, v, o, effect_flow);         // u_f, Lagrange, bases     F, G, U
  add_update(list, v, o, effect_flow);               // Lagrange, fluxes         new state, rates
  scalars::add_tasks(list, v, o, effect_scalars);    // u, u_f, F, 1/J, N        new scalars
  scalars::add_heat_release(list, v, o, effect_sources);  // f, q, remap         new state, rates
  scalars::add_reactions(list, v, o, effect_sources);     // Y, remap            new state, rates
  if (o.implicit)
    pressure::add_end_of_one(list, v, o, effect_pressure_solve);  // X, new state  R, new Y
  add_accounts(list, v, o, effects);  // fluxes, m, dp   sums, face tables
  declare_step_outputs(list, v, o, material_alone(list, v, o));  // whatever a deck saves  outputs
}

// The same where solids are in the fluid; the tasks under walls/ but for those of whole cells.
void declare_cut_material(TaskList& list, const SchemeOptions& o, const EffectList& effects) {
  SchemeVariables v = declare_conservative_variables(list, o);
  walls::declare_variables(list, o, v);
  if (o.implicit) pressure::declare_variables(list, o, v);
  scalars::declare_variables(list, o, v,
                             {std::span(&v.rho, 1), std::span(&v.walls.after_rho, 1), {}});
  walls::declare_scalar_walls(list, o, v);
  const SchemeVariables fluid = walls::fluid_face_variables(v);
  SchemeVariables open = v;
  open.stress = v.walls.whole_stress;
  open.heat_flux = v.walls.whole_heat_flux;
  // task                    reads                              writes
  walls::add_apertures(list, v, o, effect_solids);          // theta, a           where slopes count
  add_primitives(list, v, o, effect_flow);                  // state              u, p, c
  add_face_states(list, fluid, o);                          // u, p, c            slopes, u_f, p_f
  walls::add_open_faces(list, fluid, v, o, effect_solids);  // u_f, p_f, A, C    u_f, p_f, w
  add_shock_shear(list, v, o, effect_shock_shear);          // rho, u, p, c, theta  k of faces
  if (o.implicit) pressure::add_cut_cell_system(list, v, o, effect_pressure_solve);  // w  matrix, R
  add_transport(list, v, o, effect_viscosity, effect_turbulence);  // rho, E, u  mu, k of cells
  add_viscous_stress(list, open, o, effect_viscosity);             // u                  t_f
  add_heat_flux(list, open, o, effect_conduction);                 // rho, E             T, q_f
  walls::add_shares(list, open, v, o, effect_solids);  // t_f, q_f, a        of open faces
  walls::add_lagrangian(list, v, o, effect_solids);    // state, faces       Lagrange, donors
  add_bases_and_fluxes(list, v, o);                    // Lagrange, slopes   F, G, U
  walls::add_update(list, v, o, effect_solids);        // Lagrange, fluxes   new state, rates
  if (o.implicit)
    pressure::add_cut_cell_end_of_step(list, v, o,
                                       effect_pressure_solve);  // X, new state  R, new Y
  SchemeVariables sides = v;  // what passes through the sides of the domain
  sides.face_velocity = v.walls.flow;
  walls::add_scalar_walls(list, v, o, effect_solids);  // rho, theta, open   M, weights
  scalars::add_tasks(list, sides, o, effect_scalars);  // u, w, F, 1/J, N    new scalars
  add_accounts(list, sides, o, effects);               // fluxes, m, dp   sums, face tables
  SchemeVariables saved = v;
  saved.rho_new = v.walls.after_rho;
  saved.momentum_new = v.walls.after_momentum;
  saved.energy_new = v.walls.after_energy;
  declare_step_outputs(list, saved, o, material_alone(list, saved, o));  // what a deck saves
}

// The same where several materials may meet; the tasks of that name under mixture/, but for those
// of the mixture as a whole.
void declare_mixture(TaskList& list, const SchemeOptions& o, const EffectList& effects) {
  mixture::Variables m = mixture::declare_variables(list, o);
  SchemeVariables& v = m.common;
  if (o.implicit) pressure::declare_variables(list, o, v);
  scalars::declare_variables(list, o, v, {m.mass, m.mass_remap, m.volume});
  // task                            reads                              writes
  mixture::add_primitives(list, m, o, effect_equilibration);   // state      who is where, u, p, c
  add_face_states(list, v, o);                                 // u, p       slopes, u_f, p_f
  add_shock_shear(list, v, o, effect_shock_shear);             // u, p, c    k along shocks
  mixture::add_surface(list, m, o, effect_momentum_exchange);  // V_m       where gas slips
  mixture::add_friction(list, m, o);                           // V_m, T_m, u  mu, t_f
  mixture::add_heat_flux(list, m, o, effect_conduction);       // T_m        q_f, of each material
  mixture::add_transported_heat(list, m, o, o.conducting ? effect_conduction : effect_viscosity);
  mixture::add_lagrangian(list, m, o, effect_flow);             // u_f, p_f   E_mL, scales
  mixture::add_remap_bases(list, m, o, effect_second_order);    // Lagrange   bases
  mixture::add_remap_fluxes(list, m, o, effect_flow);           // bases      FV, FM, FE of each, U
  mixture::add_update(list, m, o, effect_equilibration);        // fluxes     new state, rates
  scalars::add_tasks(list, v, o, effect_scalars);               // u_f, fluxes  new scalars
  mixture::add_one_pressure(list, m, o, effect_equilibration);  // remap, f  new state, rates
  if (o.implicit)
    pressure::add_end_of_mixture(list, m, v, o, effect_pressure_solve);  // X, new state  R, new Y
  add_accounts(list, v, o, effects);  // fluxes, m, dp   sums, face tables
  declare_step_outputs(list, v, o, mixture::materials_of_step(list, m, o));  // saved  outputs
}

// The same where solids are in the fluids; where they move apart (slip), they do so in cells that
// no solid touches.
void declare_cut_mixture(TaskList& list, const SchemeOptions& o, const EffectList& effects) {
  mixture::Variables m = mixture::declare_variables(list, o);
  SchemeVariables& v = m.common;
  walls::declare_variables(list, o, v);
  if (o.implicit) pressure::declare_variables(list, o, v);
  const walls::MaterialVariables x = walls::declare_materials(list, o, m);
  scalars::declare_variables(list, o, v, {m.mass, m.mass_remap, m.volume});
  walls::declare_scalar_walls(list, o, v);
  const bool apart = o.multi_velocity;
  const SchemeVariables moving = apart ? walls::volume_variables(m) : v;
  const SchemeVariables fluid = walls::fluid_face_variables(moving);
  mixture::Variables open = m;
  open.common.stress = v.walls.whole_stress;
  open.common.heat_flux = v.walls.whole_heat_flux;
  open.heat_flux = x.whole_heat_of_each;
  mixture::Variables cells = m;  // amounts, as the update takes them
  cells.common.momentum = v.walls.momentum;
  SchemeOptions masked = o;
  masked.masked = true;
  constexpr int slip = effect_momentum_exchange;
  // task                            reads                              writes
  walls::add_cut_cells(list, m, o, effect_solids);            // theta      which cells solids touch
  walls::add_apertures(list, v, o, effect_solids);            // theta, a   where slopes count
  mixture::add_primitives(list, m, o, effect_equilibration);  // state      who is where, u, p, c
  if (apart) mixture::add_slip_motion(list, m, o, slip);      // state      u_m, u, c of volume
  add_face_states(list, fluid, o);                            // u, p       slopes, u_f, p_f
  walls::add_open_faces(list, fluid, v, o, effect_solids);    // u_f, A, C  u_f, p_f, w
  add_shock_shear(list, v, o, effect_shock_shear);            // u, p, c    k along shocks
  if (o.implicit)
    pressure::add_cut_cell_system(list, moving, o, effect_pressure_solve);  // w  matrix
  mixture::add_friction(list, open, o);                                     // V_m, T_m, u  mu, t_f
  if (apart) mixture::add_slip_stress(list, open, o, effect_viscosity);     // u_m  t of each
  mixture::add_heat_flux(list, open, o, effect_conduction);   // T_m        q_f, of each material
  walls::add_shares(list, open.common, v, o, effect_solids);  // t_f, a     of open faces
  if (apart) walls::add_stress_of_open_faces(list, open, m, o, effect_solids);
  walls::add_heat_of_open_faces(list, m, x, o, effect_solids);
  mixture::add_transported_heat(list, m, o, o.conducting ? effect_conduction : effect_viscosity);
  walls::add_lagrangian(list, v, o, effect_solids);  // state, faces  Lagrange, donors
  const mixture::Variables whole = walls::full_cell_variables(m);
  if (apart) mixture::add_slip_phase(list, m, o, slip);  // p_f        w_mL, drift, work
  mixture::add_lagrangian_of_each(list, whole, o, effect_flow);
  walls::add_shares_of_each(list, m, x, o, effect_solids);   // Lagrange   E_mL of touched cells
  if (apart) mixture::add_slip_faces(list, whole, o, slip);  // drift      u_fm, outflow
  mixture::Variables bases = m;
  bases.common = walls::base_variables(v);
  mixture::add_remap_bases(list, bases, masked, effect_second_order);  // Lagrange   bases
  if (apart) mixture::add_slip_bases(list, bases, masked, slip);       // Lagrange   bases of u_m
  for (int axis = 0; axis < o.axes.count; ++axis) {
    const mixture::Variables remap = walls::full_cell_remap(m, x, axis);
    apart ? mixture::add_slip_flux(list, remap, masked, effect_flow, axis)
          : mixture::add_remap_flux(list, remap, masked, effect_flow, axis);
  }
  walls::add_fluxes_of_cut_cells(list, m, x, o, effect_solids);  // E_mL      FV, FM, FE of each, U
  apart ? mixture::add_slip_update(list, cells, o, effect_equilibration)  // fluxes  new state
        : mixture::add_update(list, cells, o, effect_equilibration);      //         and rates
  if (o.implicit)
    pressure::add_end_of_mixture(list, m, moving, o, effect_pressure_solve);  // X, new state  R, Y
  mixture::Variables sides = m;
  sides.common.face_velocity = v.walls.flow;
  walls::add_scalar_walls(list, v, o, effect_solids);  // M_m, theta  M, weights
  const SchemeVariables carrying =
      apart ? scalars::add_own_motion(list, sides, o, effect_scalars) : sides.common;
  scalars::add_tasks(list, carrying, o, effect_scalars);  // w, fluxes   new scalars
  add_accounts(list, sides.common, o, effects);
  if (apart) mixture::add_relative_velocity_force_budget(list, m, o, effect_of_forces(o));
  declare_step_outputs(list, v, o, mixture::materials_of_step(list, m, o));
}

// The same without solids, where each material has a velocity of its own: mixture/slip.hpp.
void declare_multi_velocity(TaskList& list, const SchemeOptions& o, const EffectList& effects) {
  mixture::Variables m = mixture::declare_variables(list, o);
  scalars::declare_variables(list, o, m.common, {m.mass, m.mass_new, m.volume});
  if (o.implicit) {
    pressure::declare_variables(list, o, m.common);
    m.slip.common.solve = m.common.solve;
  }
  const SchemeVariables &v = m.common, &volume = m.slip.common;
  constexpr int slip = effect_momentum_exchange;
  // task                            reads                              writes
  mixture::add_primitives(list, m, o, effect_equilibration);  // state      who is where, u, p, c
  mixture::add_surface(list, m, o, slip);                     // V_m        where gas slips
  mixture::add_slip_motion(list, m, o, slip);                 // state      u_m, u, c of volume
  add_face_states(list, volume, o);                           // u, p       slopes, u_f, p_f
  add_shock_shear(list, v, o, effect_shock_shear);            // u, p, c    k along shocks
  mixture::add_friction(list, m, o);                          // V_m, T_m, u  mu, t_f
  mixture::add_slip_stress(list, m, o, effect_viscosity);     // u_m        t of each
  mixture::add_slip_phase(list, m, o, slip);                  // p_f        w_mL, drift, work
  mixture::add_heat_flux(list, m, o, effect_conduction);      // T_m        q_f, of each material
  mixture::add_transported_heat(list, m, o, o.conducting ? effect_conduction : effect_viscosity);
  mixture::add_lagrangian(list, m, o, effect_flow);            // u_f, p_f   E_mL, scales
  mixture::add_slip_faces(list, m, o, slip);                   // drift      u_fm, outflow
  mixture::add_remap_bases(list, m, o, effect_second_order);   // Lagrange   bases
  mixture::add_slip_bases(list, m, o, slip);                   // Lagrange   bases of u_m
  mixture::add_slip_fluxes(list, m, o, effect_flow);           // bases      FV, FM, FE, U of each
  mixture::add_slip_update(list, m, o, effect_equilibration);  // fluxes     new state, rates
  if (o.implicit)
    pressure::add_end_of_mixture(list, m, volume, o, effect_pressure_solve);  // X, state  R, Y
  scalars::add_tasks(list, scalars::add_own_motion(list, m, o, effect_scalars), o, effect_scalars);
  add_accounts(list, v, o, effects);  // fluxes, m, dp   sums, face tables
  mixture::add_relative_velocity_force_budget(list, m, o, effect_of_forces(o));
  declare_step_outputs(list, v, o, mixture::materials_of_step(list, m, o));  // saved  outputs
}

// The classic form. Each line is a task (one for each axis where it says "face" or "fluxes"), in
// the file of its name under classic/ or, without "classic::", under one_material/.
void declare_internal_energy_form(TaskList& list, const SchemeOptions& o,
                                  const EffectList& effects) {
  const internal_energy_form::Variables v = declare_classic_variables(list, o);
  const SchemeVariables& s = v.common;
  // task                             reads                        writes
  add_primitives(list, s, o, effect_flow);  // state                 u, p_n, c
  internal_energy_form::add_face_velocity(list, v, o, effect_flow);  // rho, u, p_n           u_f
  internal_energy_form::add_pressure_change(list, v, o,
                                            effect_flow);  // u_f, p_n, c, E        dp, p, E*
  internal_energy_form::add_face_pressure(list, v, o, effect_flow);  // rho, p                p_f
  add_viscous_stress(list, s, o, effect_viscosity);                  // u                     t_f
  internal_energy_form::add_lagrangian(list, v, o, effect_flow);  // m, p_f, t_f, E*       m_L, E_L
  internal_energy_form::add_slopes(list, v, o,
                                   effect_second_order);      // rho, m_L, E_L, u_f    slopes
  internal_energy_form::add_fluxes(list, v, o, effect_flow);  // u_f, m_L, E_L, slopes F
  internal_energy_form::add_update(list, v, o,
                                   effect_flow);  // m_L, E*, F            new state, rates
  add_accounts(list, s, o, effects);              // fluxes, m, dp   sums, face tables
  declare_step_outputs(list, s, o, material_alone(list, s, o));  // saved         outputs
}

}  // namespace sluice::ice
