#include "ice/step_tables.hpp"

#include <type_traits>

#include "ice/budgets/tasks.hpp"
#include "ice/cut_cells/materials.hpp"
#include "ice/cut_cells/variables.hpp"
#include "ice/internal_energy_form/variables.hpp"
#include "ice/mixture/surface.hpp"
#include "ice/multi_velocity/tasks.hpp"
#include "ice/one_material/tasks.hpp"
#include "ice/outputs/materials_of_mixture.hpp"
#include "ice/outputs/step_labels.hpp"
#include "ice/pressure/end_of_mixture.hpp"
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

// Velocity and pressure of the faces, into `velocity` and `pressure`: from Riemann problems, or from
// a pressure that is solved for.
void add_face_states(TaskList& list, const SchemeVariables& v, const SchemeOptions& o,
                     const std::array<VariableId, 3>& velocity,
                     const std::array<VariableId, 3>& pressure) {
  if (o.scheme.implicit) {
    pressure::SolvedFacesInput solved = pressure::SolvedFacesInput::of(v);
    solved.face_velocity = velocity;
    solved.face_pressure = pressure;
    return pressure::add_solved_faces(list, solved, o, effect_pressure_solve);
  }
  add_slopes(list, SlopesInput::of(v), o, effect_second_order);
  FacesInput faces = FacesInput::of(v);
  faces.face_velocity = velocity;
  faces.face_pressure = pressure;
  add_faces(list, faces, o, effect_flow);
}

// What leaves through sides and levels, and what forces and models add: all steps alike.
void add_budgets(TaskList& list, const BudgetInput& v, const SchemeOptions& o,
                 const EffectList& effects) {
  if (effects.on(effect_boundary_budget))
    add_boundary_budget(list, v.faces, o, effect_boundary_budget);  // fluxes         sums
  add_gravity_budget(list, v.cells, o, effect_of_forces(o));        // m, dp          sums
  add_source_budget(list, v.source_change, o, effect_sources);      // change         sums
  add_volume_budget(list, v, o, effect_diagnostics);                // fluxes, m, dp  sums
  add_flux_record(list, v, o, effect_flux_record);                  // fluxes         face tables
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

// A row of a step: a task that is there where the first column says so. It takes its input, or the
// variables of the step from which that follows.
struct Rows {
  TaskList& list;
  const SchemeOptions& o;

  template <class Input, class From>
  void operator()(bool when, void (*add)(TaskList&, const Input&, const SchemeOptions&, int),
                  const From& v, int effect) const {
    if (!when) return;
    if constexpr (std::is_same_v<Input, From>)
      add(list, v, o, effect);
    else
      add(list, Input::of(v), o, effect);
  }
};

void add_mixture_primitives(TaskList& list, const mixture::PrimitivesInput& in,
                            const SchemeOptions& o, int effect) {
  mixture::add_primitives(list, in, o, effect);
}
void add_transport_models(TaskList& list, const TransportInput& in, const SchemeOptions& o,
                          int /*effect*/) {
  add_transport(list, in, o, effect_viscosity, effect_turbulence);
}
void add_mixture_friction(TaskList& list, const mixture::FrictionInput& in, const SchemeOptions& o,
                          int /*effect*/) {
  mixture::add_friction(list, in, o);
}
// Of materials that move apart: the stress of the mixture and of each follow here.
void add_stress_of_each(TaskList& list, mixture::Variables& m, const SchemeOptions& o, int effect) {
  if (!o.transport.viscous) return;
  const auto in = mixture::SlipStressInput::of(m);
  const mixture::SlipStress stress = mixture::add_slip_stress(list, in, o, effect);
  m.common.stress = stress.total;
  m.slip.stress = stress.each;
}

mixture::Variables declare_full_cells(TaskList& list, const SchemeOptions& o, bool apart) {
  mixture::Variables m = declare_variables(list, o);
  if (apart) mixture::declare_relative_velocities(list, o, m);
  if (o.scheme.implicit) pressure::declare_variables(list, o, m.common);
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
                                       : std::span<const VariableId>(&v.walls.after.rho, 1)));
  cut_cells::declare_scalar_walls(list, o, v);
  return m;
}

// What tasks of full cells take where solids cut some: other variables under the same names.
struct CutCellInputs {
  ViscousStressInput stress;  // of whole faces, before their open share is taken
  HeatFluxInput heat;         // likewise, and all below of several materials
  mixture::FrictionInput friction;
  mixture::HeatFluxInput heat_of_each;
  cut_cells::OpenShareInput open_stress, open_heat, open_stress_of_each, open_heat_of_each;
  mixture::LagrangianOfEachInput lagrangian;  // of the volume that passes the open share of faces
  mixture::SlipFacesInput slip_faces;
  scalars::FlowOfScalars scalars;
  BudgetInput budgets;
  RemapBasesInput bases;  // of donors
  mixture::RemapBasesInput bases_of_each;
  mixture::SlipBasesInput slip_bases;
  mixture::UpdateInput update;  // of amounts of the cell
  mixture::SlipUpdateInput slip_update;
};

void set_whole_faces(const mixture::Variables& m, const cut_cells::MaterialVariables& x,
                     CutCellInputs& s) {
  const SchemeVariables& v = m.common;
  const WallVariables& w = v.walls;
  s.stress = ViscousStressInput::of(v);
  s.heat = HeatFluxInput::of(v);
  s.friction = mixture::FrictionInput::of(m);
  s.heat_of_each = mixture::HeatFluxInput::of(m);
  s.stress.stress = s.friction.mixture.stress = w.whole_stress;
  s.heat.heat_flux = s.heat_of_each.heat_flux = w.whole_heat_flux;
  s.heat_of_each.of_materials = x.whole_heat_of_each;
  s.open_stress = {w.fraction, w.covered, w.whole_stress, v.stress};
  s.open_heat = {w.fraction, w.covered, w.whole_heat_flux, v.heat_flux};
  s.open_stress_of_each = {w.fraction, w.covered, {}, m.slip.stress};
  s.open_heat_of_each = {w.fraction, w.covered, x.whole_heat_of_each, m.heat_flux};
}

CutCellInputs inputs_of(const mixture::Variables& m, const cut_cells::MaterialVariables& x) {
  const SchemeVariables& v = m.common;
  const WallVariables& w = v.walls;
  CutCellInputs s;
  set_whole_faces(m, x, s);
  s.lagrangian = mixture::LagrangianOfEachInput::of(m);
  s.slip_faces = mixture::SlipFacesInput::of(m);
  s.scalars = scalars::FlowOfScalars::of(v);
  s.budgets = BudgetInput::of(v);
  s.lagrangian.mixture.face_velocity = s.slip_faces.face_velocity = w.flow;
  s.scalars.face_velocity = s.budgets.faces.face_velocity = w.flow;
  s.bases = RemapBasesInput::of(v);
  s.bases_of_each = mixture::RemapBasesInput::of(m);
  s.slip_bases = mixture::SlipBasesInput::of(m);
  s.bases.velocity_L = s.bases_of_each.mixture.velocity_L = w.donor_velocity;
  s.bases.mask = s.bases_of_each.mixture.mask = s.slip_bases.mask = w.base_mask;
  s.update = mixture::UpdateInput::of(m);
  s.slip_update = mixture::SlipUpdateInput::of(m);
  s.update.amounts.momentum = s.slip_update.update.amounts.momentum = w.momentum;
  return s;
}

// Friction of each material on whole faces of which the open share is taken then.
void add_open_stress_of_each(TaskList& list, const mixture::Variables& m, const SchemeOptions& o,
                             CutCellInputs& s) {
  if (!o.transport.viscous) return;
  auto in = mixture::SlipStressInput::of(m);
  in.stress = s.open_stress.whole;
  const mixture::SlipStress stress = mixture::add_slip_stress(list, in, o, effect_viscosity);
  s.open_stress.whole = stress.total;
  s.open_stress_of_each.whole = stress.each;
}

// What passes the faces, as between full cells.
void add_cut_remap_fluxes(TaskList& list, const mixture::Variables& m,
                          const cut_cells::MaterialVariables& x, const SchemeOptions& masked) {
  for (int axis = 0; axis < masked.grid.axes.count; ++axis) {
    RemapFluxInput whole = cut_cells::whole_cell_remap(m.common, axis);
    if (!masked.materials.mixture) {
      add_remap_flux(list, whole, masked, effect_flow, axis);
      continue;
    }
    whole.flux = x.whole_flux;
    if (masked.materials.multi_velocity) {
      auto in = mixture::SlipFluxInput::of(m);
      in.mixture = whole;
      in.flux = x.whole_flux_of_each;
      in.material_velocity = x.whole_velocity;
      mixture::add_slip_flux(list, in, masked, effect_flow, axis);
    } else {
      auto in = mixture::RemapFluxInput::of(m);
      in.mixture = whole;
      in.flux = x.whole_flux_of_each;
      mixture::add_remap_flux(list, in, masked, effect_flow, axis);
    }
  }
}

// Of a semi-implicit step: the error of the volume that is left.
void add_end_of_solve(TaskList& list, const mixture::Variables& m, const SchemeOptions& o) {
  using namespace pressure;
  constexpr int solve = effect_pressure_solve;
  if (!o.scheme.implicit) return;
  if (o.materials.mixture) return add_end_of_mixture(list, EndOfMixtureInput::of(m), o, solve);
  const EndOfOneInput end = EndOfOneInput::of(m.common);
  if (!o.grid.has_cut_cells) return add_end_of_one(list, end, o, solve);
  add_cut_cell_end_of_step(list, CutCellErrorInput::of(m.common), end, o, solve);
}

// Scalars of materials that move apart.
void add_scalars_of_each(TaskList& list, const mixture::Variables& m,
                         const scalars::FlowOfScalars& of_mixture, const SchemeOptions& o) {
  const scalars::OwnMotionInput own{m.slip.velocity, m.slip.outflow, m.slip.face_velocity};
  scalars::add_tasks(list, scalars::add_own_motion(list, of_mixture, own, o, effect_scalars), o,
                     effect_scalars);
}

// What solids do to fluxes of each material.
void add_cut_fluxes(TaskList& list, const mixture::Variables& m,
                    const cut_cells::MaterialVariables& x, const SchemeOptions& o) {
  cut_cells::add_fluxes_of_cut_cells(list, cut_cells::CutFluxInput::of(m, x),
                                     cut_cells::CutFluxes::of(m, x), o, effect_solids);
}

void add_slip_budget(TaskList& list, const mixture::Variables& m, const SchemeOptions& o,
                     int effect) {
  mixture::add_relative_velocity_force_budget(list, m.slip.force_work, o, effect);
}

MaterialsOfStep materials_of(TaskList& list, const mixture::Variables& m, const SchemeOptions& o) {
  return o.materials.mixture ? mixture::materials_of_step(list, m, o)
                             : material_alone(list, MaterialAloneInput::of(m.common), o);
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
  const SchemeVariables& v = m.common;
  constexpr int flow = effect_flow, second_order = effect_second_order,
                drag = effect_momentum_exchange;
  constexpr int friction = effect_viscosity, equilibrium = effect_equilibration;
  const int heat = o.transport.conducting ? effect_conduction : effect_viscosity;
  const Rows row{list, o};
  // when        task, variables, effect                          // reads -> writes
  row(one, add_primitives, v, flow);                              // state -> u, p, c
  row(several, add_mixture_primitives, m, equilibrium);           // state -> who is where, u, p, c
  row(several, mixture::add_surface, m, drag);                    // V_m -> where gas slips
  row(apart, mixture::add_slip_motion, m, drag);                  // state -> u_m; u, c of volume
  add_face_states(list, v, o, v.face_velocity, v.face_pressure);  // u, p, c -> slopes, u_f, p_f
  row(true, add_shock_shear, v, effect_shock_shear);              // u, p, c -> k along shocks
  row(one, add_transport_models, v, friction);                    // rho, E, u -> mu, k of cells
  row(one, add_viscous_stress, v, friction);                      // u -> t_f
  row(one, add_heat_flux, v, effect_conduction);                  // rho, E -> T, q_f
  row(several, add_mixture_friction, m, friction);                // V_m, T_m, u -> mu, t_f
  if (apart) add_stress_of_each(list, m, o, friction);            // u_m -> t of each
  row(apart, mixture::add_slip_phase, m, drag);                   // p_f -> w_mL, drift, work
  row(several, mixture::add_heat_flux, m, effect_conduction);     // T_m -> q_f of each
  row(several, mixture::add_transported_heat, m, heat);           // t_f, q_f -> heat of each
  row(one, add_lagrangian, v, flow);                              // faces -> rho_L, E_L, v, E*
  row(several, add_lagrangian, v, flow);                          // faces -> rho_L, E_L, v, E*
  row(several, mixture::add_lagrangian_of_each, m, flow);         // u_f, p_f -> E_mL, scales
  row(apart, mixture::add_slip_faces, m, drag);                   // drift -> u_fm, outflow
  row(one, add_remap_bases, v, second_order);                     // Lagrange -> bases
  row(several, mixture::add_remap_bases, m, second_order);        // Lagrange -> bases
  row(apart, mixture::add_slip_bases, m, drag);                   // Lagrange -> bases of u_m
  row(one, add_remap_fluxes, v, flow);                            // u_f, bases -> F, G, U
  row(together, mixture::add_remap_fluxes, m, flow);              // bases -> FV, FM, FE of each, U
  row(apart, mixture::add_slip_fluxes, m, flow);                  // bases -> FV, FM, FE, U of each
  row(one, add_update, v, flow);                                  // fluxes -> new state, rates
  row(together, mixture::add_update, m, equilibrium);             // fluxes -> new state, rates
  row(apart, mixture::add_slip_update, m, equilibrium);           // fluxes -> new state, rates
  row(!apart, scalars::add_tasks, v, effect_scalars);             // u, u_f, F, 1/J -> new scalars
  row(one, scalars::add_heat_release, v, effect_sources);         // f, q, remap -> new state
  row(one, scalars::add_reactions, v, effect_sources);            // Y, remap -> new state
  row(together, mixture::add_one_pressure, m, equilibrium);       // f, remap -> new state
  add_end_of_solve(list, m, o);                                   // X, new state -> R, new Y
  if (apart)
    add_scalars_of_each(list, m, scalars::FlowOfScalars::of(v), o);  // u_m, fluxes -> new scalars
  add_budgets(list, BudgetInput::of(v), o, effects);                 // fluxes, m, dp -> sums
  row(apart, add_slip_budget, m, effect_of_forces(o));               // work on slip -> sums
  declare_step_outputs(list, OutputInput::of(v), o, materials_of(list, m, o));
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
  CutCellInputs s = inputs_of(m, x);
  constexpr int flow = effect_flow, second_order = effect_second_order,
                drag = effect_momentum_exchange;
  constexpr int friction = effect_viscosity, equilibrium = effect_equilibration;
  constexpr int solids = effect_solids;
  const int heat = o.transport.conducting ? effect_conduction : effect_viscosity;
  SchemeOptions masked = o;
  masked.scheme.masked = true;  // weights of slopes take the place of the mask of a redone step
  const Rows row{list, o}, masked_row{list, masked};
  // when        task, variables, effect                             // reads -> writes
  row(several, cut_cells::add_cut_cells, m, solids);     // theta -> which cells are cut
  row(true, cut_cells::add_apertures, v, solids);        // theta, a -> where slopes count
  row(one, add_primitives, v, flow);                     // state -> u, p, c
  row(several, add_mixture_primitives, m, equilibrium);  // state -> who is where, u, p, c
  row(apart, mixture::add_slip_motion, m, drag);         // state -> u_m; u, c of volume
  add_face_states(list, v, o, v.walls.fluid_velocity,
                  v.walls.fluid_pressure);            // u, p, c -> u_f, p_f
  row(true, cut_cells::add_open_faces, v, solids);    // u_f, p_f, A, C -> u_f, p_f, w
  row(true, add_shock_shear, v, effect_shock_shear);  // u, p, c -> k along shocks
  row(o.scheme.implicit, pressure::add_cut_cell_system, v,
      effect_pressure_solve);                                // w -> matrix
  row(one, add_transport_models, v, friction);               // rho, E, u -> mu, k of cells
  row(one, add_viscous_stress, s.stress, friction);          // u -> t_f
  row(one, add_heat_flux, s.heat, effect_conduction);        // rho, E -> T, q_f
  row(several, add_mixture_friction, s.friction, friction);  // V_m, T_m, u -> mu, t_f
  if (apart) add_open_stress_of_each(list, m, o, s);         // u_m -> t of each
  row(several, mixture::add_heat_flux, s.heat_of_each, effect_conduction);  // T_m -> q_f of each
  cut_cells::add_shares(list, s.open_stress, s.open_heat, o,
                        solids);  // t_f, q_f, a -> of open faces
  row(apart, cut_cells::add_stress_of_open_faces, s.open_stress_of_each, solids);
  row(several, cut_cells::add_heat_of_open_faces, s.open_heat_of_each, solids);
  row(several, mixture::add_transported_heat, m, heat);  // t_f, q_f -> heat of each
  row(true, cut_cells::add_lagrangian, v, solids);       // faces -> Lagrange, donors
  row(apart, mixture::add_slip_phase, m, drag);          // p_f -> w_mL, drift, work
  row(several, mixture::add_lagrangian_of_each, s.lagrangian,
      flow);  // Lagrange -> E_mL, full cells
  row(several, cut_cells::add_shares_of_each, cut_cells::SharesOfEachInput::of(m, x),
      solids);                                              // Lagrange -> E_mL, cut cells
  row(apart, mixture::add_slip_faces, s.slip_faces, drag);  // drift -> u_fm, outflow
  masked_row(one, add_remap_bases, s.bases, second_order);  // Lagrange -> bases
  masked_row(several, mixture::add_remap_bases, s.bases_of_each,
             second_order);                                          // Lagrange -> bases
  masked_row(apart, mixture::add_slip_bases, s.slip_bases, drag);    // Lagrange -> bases of u_m
  add_cut_remap_fluxes(list, m, x, masked);                          // bases -> fluxes, full faces
  if (several) add_cut_fluxes(list, m, x, o);                        // E_mL -> fluxes
  row(one, cut_cells::add_update, v, solids);                        // fluxes -> new state, rates
  row(together, mixture::add_update, s.update, equilibrium);         // fluxes -> new state, rates
  row(apart, mixture::add_slip_update, s.slip_update, equilibrium);  // fluxes -> new state, rates
  add_end_of_solve(list, m, o);                                      // X, new state -> R, new Y
  row(true, cut_cells::add_scalar_walls, v, solids);                 // theta, open -> M, weights
  row(!apart, scalars::add_tasks, s.scalars, effect_scalars);        // w, F, 1/J -> new scalars
  if (apart) add_scalars_of_each(list, m, s.scalars, o);             // u_m, fluxes -> new scalars
  add_budgets(list, s.budgets, o, effects);                          // fluxes, m, dp -> sums
  row(apart, add_slip_budget, m, effect_of_forces(o));               // work on slip -> sums
  declare_step_outputs(list, OutputInput::of(v), o, materials_of(list, m, o));
}

// The classic form. Each line is a task (one for each axis where it says "face" or "fluxes"), in
// the file of its name under the folder of its namespace or, without one, under one_material/.
void declare_step_of_internal_energy(TaskList& list, const SchemeOptions& o,
                                     const EffectList& effects) {
  const internal_energy_form::Variables v = declare_classic_variables(list, o);
  const SchemeVariables& s = v.common;
  // task                             reads                        writes
  add_primitives(list, PrimitivesInput::of(s), o, effect_flow);  // state                 u, p_n, c
  internal_energy_form::add_face_velocity(list, v, o, effect_flow);  // rho, u, p_n           u_f
  internal_energy_form::add_pressure_change(list, v, o,
                                            effect_flow);  // u_f, p_n, c, E        dp, p, E*
  internal_energy_form::add_face_pressure(list, v, o, effect_flow);  // rho, p                p_f
  add_viscous_stress(list, ViscousStressInput::of(s), o,
                     effect_viscosity);                           // u                     t_f
  internal_energy_form::add_lagrangian(list, v, o, effect_flow);  // m, p_f, t_f, E*       m_L, E_L
  internal_energy_form::add_slopes(list, v, o,
                                   effect_second_order);      // rho, m_L, E_L, u_f    slopes
  internal_energy_form::add_fluxes(list, v, o, effect_flow);  // u_f, m_L, E_L, slopes F
  internal_energy_form::add_update(list, v, o,
                                   effect_flow);      // m_L, E*, F            new state, rates
  add_budgets(list, BudgetInput::of(s), o, effects);  // fluxes, m, dp   sums, face tables
  declare_step_outputs(
      list, OutputInput::of(s), o,
      material_alone(list, MaterialAloneInput::of(s), o));  // saved         outputs
}

}  // namespace sluice::ice
