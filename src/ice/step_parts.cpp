#include "ice/step_parts.hpp"

#include "ice/cut_cells/variables.hpp"
#include "ice/multi_velocity/tasks.hpp"
#include "ice/one_material/tasks.hpp"
#include "ice/outputs/materials_of_mixture.hpp"
#include "ice/pressure/end_of_mixture.hpp"
#include "ice/pressure/variables.hpp"
#include "ice/sources/source_tasks.hpp"
#include "ice/step/effect_ids.hpp"

namespace sluice::ice {
namespace {

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

void add_faces_to(TaskList& list, const SchemeVariables& v, const SchemeOptions& o,
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

}  // namespace

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

mixture::Variables declare_full_cells(TaskList& list, const SchemeOptions& o, bool apart) {
  mixture::Variables m = declare_variables(list, o);
  if (apart) mixture::declare_relative_velocities(list, o, m);
  if (o.scheme.implicit) pressure::declare_variables(list, o, m.common);
  std::span<const VariableId> remapped(&m.common.rho_remap, 1);
  if (o.materials.mixture) remapped = apart ? m.mass_new : m.mass_remap;
  scalars::declare_variables(list, o, m.common, masses_of(m, remapped));
  return m;
}

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

void add_face_states(TaskList& list, const SchemeVariables& v, const SchemeOptions& o) {
  add_faces_to(list, v, o, v.face_velocity, v.face_pressure);
}

void add_fluid_faces(TaskList& list, const SchemeVariables& v, const SchemeOptions& o) {
  add_faces_to(list, v, o, v.walls.fluid_velocity, v.walls.fluid_pressure);
}

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
void add_material_stress(TaskList& list, mixture::Variables& m, const SchemeOptions& o,
                         int effect) {
  if (!o.transport.viscous) return;
  const auto in = mixture::SlipStressInput::of(m);
  const mixture::SlipStress stress = mixture::add_slip_stress(list, in, o, effect);
  m.common.stress = stress.total;
  m.slip.stress = stress.each;
}

void add_end_of_solve(TaskList& list, const mixture::Variables& m, const SchemeOptions& o) {
  using namespace pressure;
  constexpr int solve = effect_pressure_solve;
  if (!o.scheme.implicit) return;
  if (o.materials.mixture) return add_end_of_mixture(list, EndOfMixtureInput::of(m), o, solve);
  const EndOfOneInput end = EndOfOneInput::of(m.common);
  if (!o.grid.has_cut_cells) return add_end_of_one(list, end, o, solve);
  add_cut_cell_end_of_step(list, CutCellErrorInput::of(m.common), end, o, solve);
}

void add_material_scalars(TaskList& list, const mixture::Variables& m,
                          const scalars::FlowOfScalars& of_mixture, const SchemeOptions& o) {
  const scalars::OwnMotionInput own{m.slip.velocity, m.slip.outflow, m.slip.face_velocity};
  scalars::add_tasks(list, scalars::add_own_motion(list, of_mixture, own, o, effect_scalars), o,
                     effect_scalars);
}

void add_budgets(TaskList& list, const BudgetInput& v, const SchemeOptions& o,
                 const EffectList& effects) {
  if (effects.on(effect_boundary_budget))
    add_boundary_budget(list, v.faces, o, effect_boundary_budget);  // fluxes         sums
  add_gravity_budget(list, v.cells, o, effect_of_forces(o));        // m, dp          sums
  add_source_budget(list, v.source_change, o, effect_sources);      // change         sums
  add_volume_budget(list, v, o, effect_diagnostics);                // fluxes, m, dp  sums
  add_flux_record(list, v, o, effect_flux_record);                  // fluxes         face tables
}

void add_slip_budget(TaskList& list, const mixture::Variables& m, const SchemeOptions& o,
                     int effect) {
  mixture::add_relative_velocity_force_budget(list, m.slip.force_work, o, effect);
}

void add_outputs(TaskList& list, const mixture::Variables& m, const SchemeOptions& o) {
  declare_step_outputs(list, OutputInput::of(m.common), o,
                       o.materials.mixture
                           ? mixture::materials_of_step(list, mixture::MaterialsInput::of(m), o)
                           : material_alone(list, MaterialAloneInput::of(m.common), o));
}

}  // namespace sluice::ice
