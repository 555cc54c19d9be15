#include "ice/step_tables.hpp"

#include "ice/budgets/tasks.hpp"
#include "ice/cut_cells/materials.hpp"
#include "ice/cut_cells/variables.hpp"
#include "ice/internal_energy_form/variables.hpp"
#include "ice/mixture/surface.hpp"
#include "ice/multi_velocity/tasks.hpp"
#include "ice/one_material/tasks.hpp"
#include "ice/outputs/materials_of_mixture.hpp"
#include "ice/outputs/step_labels.hpp"
#include "ice/pressure/variables.hpp"
#include "ice/scalars/heat_release.hpp"
#include "ice/scalars/reactions.hpp"
#include "ice/scalars/variables.hpp"
#include "ice/sources/source_tasks.hpp"
#include "ice/step/effect_ids.hpp"
#include "ice/transport/viscosity.hpp"

namespace sluice::ice {
namespace {

internal_energy_form::Variables declare_classic_variables(TaskList& list, const SchemeOptions& o) {
  const int C = o.grid.components, D = o.grid.axes.count;
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
  if (o.scheme.implicit) return pressure::add_solved_faces(list, v, o, effect_pressure_solve);
  add_slopes(list, v, o, effect_second_order);
  add_faces(list, v, o, effect_flow);
}

// What leaves through sides and levels, and what forces and models add: all steps alike.
void add_budgets(TaskList& list, const SchemeVariables& v, const SchemeOptions& o,
                 const EffectList& effects) {
  if (effects.on(effect_boundary_budget))
    add_boundary_budget(list, v, o, effect_boundary_budget);  // fluxes         sums
  add_gravity_budget(list, v, o, effect_of_forces(o));        // m, dp          sums
  add_source_budget(list, v, o, effect_sources);              // change         sums
  add_volume_budget(list, v, o, effect_diagnostics);          // fluxes, m, dp  sums
  add_flux_record(list, v, o, effect_flux_record);            // fluxes         face tables
}

mixture::Variables declare_variables(TaskList& list, const SchemeOptions& o) {
  if (o.materials.mixture) return mixture::declare_variables(list, o);
  mixture::Variables one;
  one.common = declare_conservative_variables(list, o);
  return one;
}

// The masses that carry scalars: before the step, and as the remap leaves them.
scalars::Masses masses_of(const mixture::Variables& m, std::span<const VariableId> remapped) {
  if (m.mass.empty()) return {std::span(&m.common.rho, 1), remapped, {}};
  return {m.mass, remapped, m.volume};
}

// A row of a step: a task that is there where the first column says so.
struct Rows {
  TaskList& list;
  const SchemeOptions& o;

  template <class Add, class Variables>
  void operator()(bool when, Add add, const Variables& v, int effect) const {
    if (when) add(list, v, o, effect);
  }
};

void add_mixture_primitives(TaskList& list, const mixture::Variables& m, const SchemeOptions& o,
                            int effect) {
  mixture::add_primitives(list, m, o, effect);
}
void add_transport_models(TaskList& list, const SchemeVariables& v, const SchemeOptions& o,
                          int /*effect*/) {
  add_transport(list, v, o, effect_viscosity, effect_turbulence);
}
void add_mixture_friction(TaskList& list, const mixture::Variables& m, const SchemeOptions& o,
                          int /*effect*/) {
  mixture::add_friction(list, m, o);
}

mixture::Variables declare_full_cells(TaskList& list, const SchemeOptions& o, bool apart) {
  mixture::Variables m = declare_variables(list, o);
  if (apart) mixture::declare_relative_velocities(list, o, m);
  if (o.scheme.implicit) pressure::declare_variables(list, o, m.common);
  if (o.scheme.implicit && apart) m.slip.common.solve = m.common.solve;
  std::span<const VariableId> remapped(&m.common.rho_remap, 1);
  if (o.materials.mixture) remapped = apart ? m.mass_new : m.mass_remap;
  scalars::declare_variables(list, o, m.common, masses_of(m, remapped));
  return m;
}

// `x`: what several materials need in addition.
mixture::Variables declare_cut_cells(TaskList& list, const SchemeOptions& o, bool apart,
                                     cut_cells::MaterialVariables& x) {
  mixture::Variables m = declare_variables(list, o);
  SchemeVariables& v = m.common;
  if (apart) mixture::declare_relative_velocities(list, o, m);
  cut_cells::declare_variables(list, o, v);
  if (o.scheme.implicit) pressure::declare_variables(list, o, v);
  if (o.materials.mixture) x = cut_cells::declare_materials(list, o, m);
  scalars::declare_variables(
      list, o, v,
      masses_of(m, o.materials.mixture ? std::span<const VariableId>(m.mass_remap)
                                       : std::span<const VariableId>(&v.walls.after_rho, 1)));
  cut_cells::declare_scalar_walls(list, o, v);
  return m;
}

// The variables of a step as tasks of full cells take them where solids cut some: what these call
// by one name is another variable there.
struct CutCellViews {
  SchemeVariables moving;    // of the volume, which moves as its materials do together
  SchemeVariables fluid;     // faces between cells of fluid alone
  mixture::Variables open;   // stress and heat of whole faces, before their open share is taken
  mixture::Variables flow;   // velocity of the faces: of the volume that passes their open share
  mixture::Variables bases;  // donors of the remap
  mixture::Variables cells;  // amounts, as the update takes them
  SchemeVariables saved;     // the state as outputs see it
};

CutCellViews views_of(const mixture::Variables& m, const cut_cells::MaterialVariables& x,
                      bool apart) {
  const SchemeVariables& v = m.common;
  CutCellViews s;
  s.moving = apart ? cut_cells::volume_variables(m) : v;
  s.fluid = cut_cells::fluid_face_variables(s.moving);
  s.open = s.flow = s.bases = s.cells = m;
  s.open.common.stress = v.walls.whole_stress;
  s.open.common.heat_flux = v.walls.whole_heat_flux;
  s.open.heat_flux = x.whole_heat_of_each;
  s.flow.common.face_velocity = v.walls.flow;
  s.bases.common = cut_cells::base_variables(v);
  s.cells.common.momentum = v.walls.momentum;
  s.saved = v;
  if (!m.mass.empty()) return s;
  s.saved.rho_new = v.walls.after_rho;
  s.saved.momentum_new = v.walls.after_momentum;
  s.saved.energy_new = v.walls.after_energy;
  return s;
}

// What passes the faces, as between full cells.
void add_cut_remap_fluxes(TaskList& list, const mixture::Variables& m,
                          const cut_cells::MaterialVariables& x, const SchemeOptions& masked) {
  for (int axis = 0; axis < masked.grid.axes.count; ++axis)
    if (!masked.materials.mixture)
      add_remap_flux(list, cut_cells::remap_variables(m.common, axis), masked, effect_flow, axis);
    else if (masked.materials.multi_velocity)
      mixture::add_slip_flux(list, cut_cells::full_cell_remap(m, x, axis), masked, effect_flow,
                             axis);
    else
      mixture::add_remap_flux(list, cut_cells::full_cell_remap(m, x, axis), masked, effect_flow,
                              axis);
}

// Of a semi-implicit step: the error of the volume that is left. `moving`: how the volume moves.
void add_end_of_solve(TaskList& list, const mixture::Variables& m, const SchemeVariables& moving,
                      const SchemeOptions& o) {
  constexpr int solve = effect_pressure_solve;
  if (!o.scheme.implicit) return;
  if (o.materials.mixture) return pressure::add_end_of_mixture(list, m, moving, o, solve);
  if (o.grid.has_cut_cells) return pressure::add_cut_cell_end_of_step(list, m.common, o, solve);
  pressure::add_end_of_one(list, m.common, o, solve);
}

// Scalars of materials that move apart.
void add_scalars_of_each(TaskList& list, const mixture::Variables& m, const SchemeOptions& o) {
  scalars::add_tasks(list, scalars::add_own_motion(list, m, o, effect_scalars), o, effect_scalars);
}

}  // namespace

// One conservative step of cells that are full of fluid: of one material, of several with one
// velocity, or with a velocity each ("apart": multi_velocity/tasks.hpp). Each line is a task (one
// for each axis where it says "faces" or "remap"), in the file of its name under one_material/ or
// under the folder of its namespace; when it is absent is said here or there in its first line.
void declare_step_of_full_cells(TaskList& list, const SchemeOptions& o, const EffectList& effects) {
  const bool several = o.materials.mixture, one = !several,
             apart = several && o.materials.multi_velocity;
  const bool together = several && !apart;
  mixture::Variables m = declare_full_cells(list, o, apart);
  const SchemeVariables &v = m.common, &moving = apart ? m.slip.common : m.common;
  constexpr int flow = effect_flow, second_order = effect_second_order,
                drag = effect_momentum_exchange;
  constexpr int friction = effect_viscosity, equilibrium = effect_equilibration;
  const int heat = o.transport.conducting ? effect_conduction : effect_viscosity;
  const Rows row{list, o};
  // when        task, variables, effect                          // reads -> writes
  row(one, add_primitives, v, flow);                           // state -> u, p, c
  row(several, add_mixture_primitives, m, equilibrium);        // state -> who is where, u, p, c
  row(several, mixture::add_surface, m, drag);                 // V_m -> where gas slips
  row(apart, mixture::add_slip_motion, m, drag);               // state -> u_m; u, c of volume
  add_face_states(list, moving, o);                            // u, p, c -> slopes, u_f, p_f
  row(true, add_shock_shear, v, effect_shock_shear);           // u, p, c -> k along shocks
  row(one, add_transport_models, v, friction);                 // rho, E, u -> mu, k of cells
  row(one, add_viscous_stress, v, friction);                   // u -> t_f
  row(one, add_heat_flux, v, effect_conduction);               // rho, E -> T, q_f
  row(several, add_mixture_friction, m, friction);             // V_m, T_m, u -> mu, t_f
  if (apart) mixture::add_slip_stress(list, m, o, friction);   // u_m -> t of each
  row(apart, mixture::add_slip_phase, m, drag);                // p_f -> w_mL, drift, work
  row(several, mixture::add_heat_flux, m, effect_conduction);  // T_m -> q_f of each
  row(several, mixture::add_transported_heat, m, heat);        // t_f, q_f -> heat of each
  row(one, add_lagrangian, v, flow);                           // faces -> rho_L, E_L, v, E*
  row(several, mixture::add_lagrangian, m, flow);              // u_f, p_f -> E_mL, scales
  row(apart, mixture::add_slip_faces, m, drag);                // drift -> u_fm, outflow
  row(one, add_remap_bases, v, second_order);                  // Lagrange -> bases
  row(several, mixture::add_remap_bases, m, second_order);     // Lagrange -> bases
  row(apart, mixture::add_slip_bases, m, drag);                // Lagrange -> bases of u_m
  row(one, add_remap_fluxes, v, flow);                         // u_f, bases -> F, G, U
  row(together, mixture::add_remap_fluxes, m, flow);           // bases -> FV, FM, FE of each, U
  row(apart, mixture::add_slip_fluxes, m, flow);               // bases -> FV, FM, FE, U of each
  row(one, add_update, v, flow);                               // fluxes -> new state, rates
  row(together, mixture::add_update, m, equilibrium);          // fluxes -> new state, rates
  row(apart, mixture::add_slip_update, m, equilibrium);        // fluxes -> new state, rates
  row(!apart, scalars::add_tasks, v, effect_scalars);          // u, u_f, F, 1/J -> new scalars
  row(one, scalars::add_heat_release, v, effect_sources);      // f, q, remap -> new state
  row(one, scalars::add_reactions, v, effect_sources);         // Y, remap -> new state
  row(together, mixture::add_one_pressure, m, equilibrium);    // f, remap -> new state
  add_end_of_solve(list, m, moving, o);                        // X, new state -> R, new Y
  if (apart) add_scalars_of_each(list, m, o);                  // u_m, fluxes -> new scalars
  add_budgets(list, v, o, effects);                            // fluxes, m, dp -> sums
  row(apart, mixture::add_relative_velocity_force_budget, m, effect_of_forces(o));
  declare_step_outputs(list, v, o,
                       one ? material_alone(list, v, o) : mixture::materials_of_step(list, m, o));
}

// The same of cells that solids cut; materials that move apart do so in cells that no solid cuts.
// Tasks of cells and faces that are cut are those under cut_cells/.
void declare_step_of_cut_cells(TaskList& list, const SchemeOptions& o, const EffectList& effects) {
  const bool several = o.materials.mixture, one = !several,
             apart = several && o.materials.multi_velocity;
  const bool together = several && !apart;
  cut_cells::MaterialVariables x;
  const mixture::Variables m = declare_cut_cells(list, o, apart, x);
  const SchemeVariables& v = m.common;
  CutCellViews s = views_of(m, x, apart);
  constexpr int flow = effect_flow, second_order = effect_second_order,
                drag = effect_momentum_exchange;
  constexpr int friction = effect_viscosity, equilibrium = effect_equilibration;
  constexpr int solids = effect_solids;
  const int heat = o.transport.conducting ? effect_conduction : effect_viscosity;
  SchemeOptions masked = o;
  masked.scheme.masked = true;  // weights of slopes take the place of the mask of a redone step
  const Rows row{list, o}, masked_row{list, masked};
  // when        task, variables, effect                             // reads -> writes
  row(several, cut_cells::add_cut_cells, m, solids);       // theta -> which cells are cut
  row(true, cut_cells::add_apertures, v, solids);          // theta, a -> where slopes count
  row(one, add_primitives, v, flow);                       // state -> u, p, c
  row(several, add_mixture_primitives, m, equilibrium);    // state -> who is where, u, p, c
  row(apart, mixture::add_slip_motion, m, drag);           // state -> u_m; u, c of volume
  add_face_states(list, s.fluid, o);                       // u, p, c -> slopes, u_f, p_f
  cut_cells::add_open_faces(list, s.fluid, v, o, solids);  // u_f, p_f, A, C -> u_f, p_f, w
  row(true, add_shock_shear, v, effect_shock_shear);       // u, p, c -> k along shocks
  row(o.scheme.implicit, pressure::add_cut_cell_system, s.moving,
      effect_pressure_solve);                                       // w -> matrix
  row(one, add_transport_models, v, friction);                      // rho, E, u -> mu, k of cells
  row(one, add_viscous_stress, s.open.common, friction);            // u -> t_f
  row(one, add_heat_flux, s.open.common, effect_conduction);        // rho, E -> T, q_f
  row(several, add_mixture_friction, s.open, friction);             // V_m, T_m, u -> mu, t_f
  if (apart) mixture::add_slip_stress(list, s.open, o, friction);   // u_m -> t of each
  row(several, mixture::add_heat_flux, s.open, effect_conduction);  // T_m -> q_f of each
  cut_cells::add_shares(list, s.open.common, v, o, solids);         // t_f, q_f, a -> of open faces
  if (apart) cut_cells::add_stress_of_open_faces(list, s.open, m, o, solids);
  if (several) cut_cells::add_heat_of_open_faces(list, m, x, o, solids);
  row(several, mixture::add_transported_heat, m, heat);         // t_f, q_f -> heat of each
  row(true, cut_cells::add_lagrangian, v, solids);              // faces -> Lagrange, donors
  row(apart, mixture::add_slip_phase, m, drag);                 // p_f -> w_mL, drift, work
  row(several, mixture::add_lagrangian_of_each, s.flow, flow);  // Lagrange -> E_mL, full cells
  if (several) cut_cells::add_shares_of_each(list, m, x, o, solids);  // Lagrange -> E_mL, cut cells
  row(apart, mixture::add_slip_faces, s.flow, drag);                  // drift -> u_fm, outflow
  masked_row(one, add_remap_bases, s.bases.common, second_order);     // Lagrange -> bases
  masked_row(several, mixture::add_remap_bases, s.bases, second_order);  // Lagrange -> bases
  masked_row(apart, mixture::add_slip_bases, s.bases, drag);             // Lagrange -> bases of u_m
  add_cut_remap_fluxes(list, m, x, masked);  // bases -> fluxes, full faces
  if (several) cut_cells::add_fluxes_of_cut_cells(list, m, x, o, solids);  // E_mL -> fluxes
  row(one, cut_cells::add_update, v, solids);                      // fluxes -> new state, rates
  row(together, mixture::add_update, s.cells, equilibrium);        // fluxes -> new state, rates
  row(apart, mixture::add_slip_update, s.cells, equilibrium);      // fluxes -> new state, rates
  add_end_of_solve(list, m, s.moving, o);                          // X, new state -> R, new Y
  row(true, cut_cells::add_scalar_walls, v, solids);               // theta, open -> M, weights
  row(!apart, scalars::add_tasks, s.flow.common, effect_scalars);  // w, F, 1/J -> new scalars
  if (apart) add_scalars_of_each(list, s.flow, o);                 // u_m, fluxes -> new scalars
  add_budgets(list, s.flow.common, o, effects);                    // fluxes, m, dp -> sums
  row(apart, mixture::add_relative_velocity_force_budget, m, effect_of_forces(o));
  declare_step_outputs(
      list, s.saved, o,
      one ? material_alone(list, s.saved, o) : mixture::materials_of_step(list, m, o));
}

// The classic form. Each line is a task (one for each axis where it says "face" or "fluxes"), in
// the file of its name under the folder of its namespace or, without one, under one_material/.
void declare_step_of_internal_energy(TaskList& list, const SchemeOptions& o,
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
  add_budgets(list, s, o, effects);               // fluxes, m, dp   sums, face tables
  declare_step_outputs(list, s, o, material_alone(list, s, o));  // saved         outputs
}

}  // namespace sluice::ice
