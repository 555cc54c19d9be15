#include "ice/cut_cell_inputs.hpp"

#include "ice/step/effect_ids.hpp"

namespace sluice::ice {

namespace {

WholeFaceInputs whole_face_inputs(const mixture::Variables& m,
                                  const cut_cells::MaterialVariables& x) {
  const SchemeVariables& v = m.common;
  WholeFaceInputs s;
  const WallVariables& w = v.walls;
  s.stress = ViscousStressInput::of(v);
  s.heat = HeatFluxInput::of(v);
  s.friction = mixture::FrictionInput::of(m);
  s.heat_of_each = mixture::HeatFluxInput::of(m);
  s.stress.stress = s.friction.mixture.stress = w.whole_stress;
  s.heat.heat_flux = s.heat_of_each.heat_flux = w.whole_heat_flux;
  s.heat_of_each.of_materials = x.full_face_material_heat;
  return s;
}

}  // namespace

CutCellInputs CutCellInputs::of(const mixture::Variables& m,
                                const cut_cells::MaterialVariables& x) {
  const SchemeVariables& v = m.common;
  const WallVariables& w = v.walls;
  CutCellInputs s;
  s.whole = whole_face_inputs(m, x);
  s.open.stress = {w.fraction, w.covered, w.whole_stress, v.stress};
  s.open.heat_flux = {w.fraction, w.covered, w.whole_heat_flux, v.heat_flux};
  s.open_stresses = {w.fraction, w.covered, {}, m.slip.stress};
  s.open_heats = {w.fraction, w.covered, x.full_face_material_heat, m.heat_flux};
  s.lagrangian = mixture::MaterialLagrangianInput::of(m);
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

void add_whole_stresses(TaskList& list, const mixture::Variables& m, const SchemeOptions& o,
                        CutCellInputs& s) {
  if (!o.transport.viscous) return;
  auto in = mixture::SlipStressInput::of(m);
  in.stress = s.open.stress.whole;
  const mixture::SlipStress stress = mixture::add_slip_stress(list, in, o, effect_viscosity);
  s.open.stress.whole = stress.total;
  s.open_stresses.whole = stress.each;
}

void add_whole_fluxes(TaskList& list, const mixture::Variables& m,
                      const cut_cells::MaterialVariables& x, const SchemeOptions& masked) {
  for (int axis = 0; axis < masked.grid.axes.count; ++axis) {
    RemapFluxInput whole = cut_cells::full_cell_remap(m.common, axis);
    if (!masked.materials.mixture) {
      add_remap_flux(list, whole, masked, effect_flow, axis);
      continue;
    }
    whole.flux = x.whole_flux;
    if (masked.materials.multi_velocity) {
      auto in = mixture::SlipFluxInput::of(m);
      in.mixture = whole;
      in.flux = x.full_face_material_flux;
      in.material_velocity = x.full_face_velocity;
      mixture::add_slip_flux(list, in, masked, effect_flow, axis);
    } else {
      auto in = mixture::RemapFluxInput::of(m);
      in.mixture = whole;
      in.flux = x.full_face_material_flux;
      mixture::add_remap_flux(list, in, masked, effect_flow, axis);
    }
  }
}

}  // namespace sluice::ice
