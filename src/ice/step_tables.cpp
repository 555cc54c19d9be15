#include "ice/step_tables.hpp"

#include "ice/cut_cell_inputs.hpp"
#include "ice/mixture/surface.hpp"
#include "ice/parabolas/tasks.hpp"
#include "ice/pressure/variables.hpp"
#include "ice/scalars/heat_release.hpp"
#include "ice/scalars/reactions.hpp"
#include "ice/step/effect_ids.hpp"
#include "ice/step_parts.hpp"

namespace sluice::ice {

// One conservative step of cells that are full of fluid: of one material, of several with one
// velocity, or with a velocity each ("apart": multi_velocity/tasks.hpp). Each line is a task (one
// for each axis where it says "faces" or "remap"), in the file of its name under one_material/ or
// under the folder of its namespace; when it is absent is said here or there in its first line.
void declare_step_of_full_cells(TaskList& list, const SchemeOptions& o, const EffectList& effects) {
  const bool several = o.materials.mixture, one = !several;
  const bool apart = several && o.materials.multi_velocity, together = several && !apart;
  const bool traced = o.scheme.third_order, remapped = one && !traced;
  mixture::Variables m = declare_full_cells(list, o, apart);
  const SchemeVariables& v = m.common;
  constexpr int flow = effect_flow, second_order = effect_second_order,
                drag = effect_momentum_exchange;
  constexpr int friction = effect_viscosity, conduction = effect_conduction,
                equilibrium = effect_equilibration, sources = effect_sources;
  const int heat = o.transport.conducting ? conduction : friction;
  const Rows row{list, o};
  // when        task, variables, effect                       // reads -> writes
  row(one, add_primitives, v, flow);                         // state -> u, p, c
  row(several, add_mixture_primitives, m, equilibrium);      // state -> who is where, u, p, c
  row(several, mixture::add_surface, m, drag);               // V_m -> where gas slips
  row(apart, mixture::add_slip_motion, m, drag);             // state -> u_m; u, c of volume
  row(traced, add_traced_states, v, second_order);           // rho, u, p -> states at edges
  row(traced, add_traced_fluxes, v, flow);                   // these -> u_f, p_f, F, G, U
  row(traced, add_slopes, v, second_order);                  // u, p -> slopes: of scalars alone
  if (!traced) add_face_states(list, v, o);                  // u, p, c -> slopes, u_f, p_f
  row(true, add_shock_shear, v, effect_shock_shear);         // u, p, c -> k along shocks
  row(one, add_transport_models, v, friction);               // rho, E, u -> mu, k of cells
  row(one, add_viscous_stress, v, friction);                 // u -> t_f
  row(one, add_heat_flux, v, conduction);                    // rho, E -> T, q_f
  row(several, add_mixture_friction, m, friction);           // V_m, T_m, u -> mu, t_f
  if (apart) add_material_stress(list, m, o, friction);      // u_m -> t of each
  row(apart, mixture::add_slip_phase, m, drag);              // p_f -> w_mL, drift, work
  row(several, mixture::add_heat_flux, m, conduction);       // T_m -> q_f of each
  row(several, mixture::add_transported_heat, m, heat);      // t_f, q_f -> heat of each
  row(true, add_lagrangian, v, flow);                        // faces -> rho_L, E_L, v, E*
  row(several, mixture::add_material_lagrangian, m, flow);   // u_f, p_f -> E_mL, scales
  row(apart, mixture::add_slip_faces, m, drag);              // drift -> u_fm, outflow
  row(remapped, add_remap_bases, v, second_order);           // Lagrange -> bases
  row(several, mixture::add_remap_bases, m, second_order);   // Lagrange -> bases
  row(apart, mixture::add_slip_bases, m, drag);              // Lagrange -> bases of u_m
  row(remapped, add_remap_fluxes, v, flow);                  // u_f, bases -> F, G, U
  row(together, mixture::add_remap_fluxes, m, flow);         // bases -> FV, FM, FE of each, U
  row(apart, mixture::add_slip_fluxes, m, flow);             // bases -> FV, FM, FE, U of each
  row(one, add_update, v, flow);                             // fluxes -> new state, rates
  row(together, mixture::add_update, m, equilibrium);        // fluxes -> new state, rates
  row(apart, mixture::add_slip_update, m, equilibrium);      // fluxes -> new state, rates
  row(!apart, scalars::add_tasks, v, effect_scalars);        // u, u_f, F, 1/J -> new scalars
  row(one, scalars::add_heat_release, v, sources);           // f, q, remap -> new state
  row(one, scalars::add_reactions, v, sources);              // Y, remap -> new state
  row(together, mixture::add_one_pressure, m, equilibrium);  // f, remap -> new state
  add_end_of_solve(list, m, o);                              // X, new state -> R, new Y
  if (apart)
    add_material_scalars(list, m, scalars::FlowOfScalars::of(v), o);  // u_m, fluxes -> new scalars
  add_budgets(list, BudgetInput::of(v), o, effects);                  // fluxes, m, dp -> sums
  if (apart) add_slip_budget(list, m, o, effect_of_forces(o));        // work on slip -> sums
  add_outputs(list, m, o);                                            // all -> what is saved
}

// The same of cells that solids cut; materials that move apart do so in cells that no solid cuts.
// Tasks of cells and faces that are cut are those under cut_cells/.
void declare_step_of_cut_cells(TaskList& list, const SchemeOptions& o, const EffectList& effects) {
  const bool several = o.materials.mixture, one = !several;
  const bool apart = several && o.materials.multi_velocity, together = several && !apart;
  cut_cells::MaterialVariables x;
  const mixture::Variables m = declare_cut_cells(list, o, apart, x);
  const SchemeVariables& v = m.common;
  CutCellInputs s = CutCellInputs::of(m, x);
  const cut_cells::OfEachInput each = cut_cells::OfEachInput::of(m, x);
  constexpr int flow = effect_flow, second_order = effect_second_order,
                drag = effect_momentum_exchange, solve = effect_pressure_solve;
  constexpr int friction = effect_viscosity, conduction = effect_conduction,
                equilibrium = effect_equilibration, solids = effect_solids;
  const int heat = o.transport.conducting ? conduction : friction;
  SchemeOptions masked = o;
  masked.scheme.masked = true;  // weights of slopes take the place of the mask of a redone step
  const Rows row{list, o}, masked_row{list, masked};
  // when        task, variables, effect                                  // reads -> writes
  row(several, cut_cells::add_cut_cells, m, solids);                       // theta -> who is cut
  row(true, cut_cells::add_apertures, v, solids);                          // theta, a -> open
  row(one, add_primitives, v, flow);                                       // state -> u, p, c
  row(several, add_mixture_primitives, m, equilibrium);                    // state -> u, p, c
  row(apart, mixture::add_slip_motion, m, drag);                           // state -> u_m; u, c
  add_fluid_faces(list, v, o);                                             // u, p, c -> u_f, p_f
  row(true, cut_cells::add_open_faces, v, solids);                         // A, C -> u_f, p_f, w
  row(true, add_shock_shear, v, effect_shock_shear);                       // u, p, c -> k
  row(o.scheme.implicit, pressure::add_cut_cell_system, v, solve);         // w -> matrix
  row(one, add_transport_models, v, friction);                             // rho, E, u -> mu, k
  row(one, add_viscous_stress, s.whole.stress, friction);                  // u -> t_f
  row(one, add_heat_flux, s.whole.heat, conduction);                       // rho, E -> T, q_f
  row(several, add_mixture_friction, s.whole.friction, friction);          // T_m, u -> mu, t_f
  if (apart) add_whole_stresses(list, m, o, s);                            // u_m -> t of each
  row(several, mixture::add_heat_flux, s.whole.heat_of_each, conduction);  // T_m -> q_f of each
  row(true, cut_cells::add_shares, s.open, solids);                        // t_f, q_f, a -> open
  row(apart, cut_cells::add_open_stresses, s.open_stresses, solids);       // the same of each
  row(several, cut_cells::add_open_heats, s.open_heats, solids);           // the same of each
  row(several, mixture::add_transported_heat, m, heat);                    // t_f, q_f -> heat
  row(true, cut_cells::add_lagrangian, v, solids);                         // faces -> donors
  row(apart, mixture::add_slip_phase, m, drag);                            // p_f -> w_mL, drift
  row(several, mixture::add_material_lagrangian, s.lagrangian, flow);      // full cells: E_mL
  row(several, cut_cells::add_material_shares, each.shares, solids);       // cut cells: E_mL
  row(apart, mixture::add_slip_faces, s.slip_faces, drag);                 // drift -> u_fm
  masked_row(one, add_remap_bases, s.bases, second_order);                 // Lagrange -> bases
  masked_row(several, mixture::add_remap_bases, s.bases_of_each, second_order);  // the same
  masked_row(apart, mixture::add_slip_bases, s.slip_bases, drag);                // the same of u_m
  add_whole_fluxes(list, m, x, masked);                                   // full faces: fluxes
  row(several, cut_cells::add_fluxes_of_cut_cells, each.fluxes, solids);  // E_mL -> fluxes
  row(one, cut_cells::add_update, v, solids);                             // fluxes -> new state
  row(together, mixture::add_update, s.update, equilibrium);              // fluxes -> new state
  row(apart, mixture::add_slip_update, s.slip_update, equilibrium);       // fluxes -> new state
  add_end_of_solve(list, m, o);                                           // X, state -> R, Y
  row(true, cut_cells::add_scalar_walls, v, solids);                      // theta -> M, weights
  row(!apart, scalars::add_tasks, s.scalars, effect_scalars);             // F -> new scalars
  if (apart) add_material_scalars(list, m, s.scalars, o);                 // F -> new scalars
  add_budgets(list, s.budgets, o, effects);                               // fluxes -> sums
  if (apart) add_slip_budget(list, m, o, effect_of_forces(o));            // slip -> sums
  add_outputs(list, m, o);                                                // all -> saved
}

// The classic form. Each line is a task (one for each axis where it says "face" or "fluxes"), in
// the file of its name under the folder of its namespace or, without one, under one_material/.
void declare_step_of_internal_energy(TaskList& list, const SchemeOptions& o,
                                     const EffectList& effects) {
  const internal_energy_form::Variables v = declare_classic_variables(list, o);
  const SchemeVariables& s = v.common;
  constexpr int flow = effect_flow, second_order = effect_second_order;
  const Rows row{list, o};
  // when   task, variables, effect                                // reads -> writes
  row(true, add_primitives, s, flow);                             // state -> u, p_n, c
  row(true, internal_energy_form::add_face_velocity, v, flow);    // rho, u, p_n -> u_f
  row(true, internal_energy_form::add_pressure_change, v, flow);  // u_f, p_n -> dp, p, E*
  row(true, internal_energy_form::add_face_pressure, v, flow);    // rho, p -> p_f
  row(true, add_viscous_stress, s, effect_viscosity);             // u -> t_f
  row(true, internal_energy_form::add_lagrangian, v, flow);       // p_f, E* -> m_L, E_L
  row(true, internal_energy_form::add_slopes, v, second_order);   // rho, m_L, E_L -> slopes
  row(true, internal_energy_form::add_fluxes, v, flow);           // u_f, slopes -> F
  row(true, internal_energy_form::add_update, v, flow);           // E*, F -> new state, rates
  add_budgets(list, BudgetInput::of(s), o, effects);              // fluxes, m, dp -> sums
  declare_step_outputs(list, OutputInput::of(s), o,               // all -> what is saved
                       material_alone(list, MaterialAloneInput::of(s), o));
}

}  // namespace sluice::ice
