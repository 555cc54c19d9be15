// What the tasks beside solids take of the variables of a step.
#include "ice/cut_cells/materials.hpp"

namespace sluice::ice::cut_cells {

AperturesInput AperturesInput::of(const SchemeVariables& v) {
  return {.mask = v.mask,
          .fraction = v.walls.fraction,
          .covered = v.walls.covered,
          .open = v.walls.open};
}

OpenFacesInput OpenFacesInput::of(const SchemeVariables& v) {
  const WallVariables& w = v.walls;
  return {.fraction = w.fraction,
          .next = w.next,
          .wall_pressure = w.pressure,
          .mean_covered = w.mean_covered,
          .swept = w.swept,
          .solid_velocity = w.solid_velocity,
          .fluid_velocity = w.fluid_velocity,
          .fluid_pressure = w.fluid_pressure,
          .face_velocity = v.face_velocity,
          .face_pressure = v.face_pressure,
          .raw_flow = w.raw_flow,
          .flow = w.flow,
          .outflow = w.outflow};
}

LagrangianInput LagrangianInput::of(const SchemeVariables& v) {
  const WallVariables& w = v.walls;
  return {.momentum = v.momentum,
          .fluid = ice::LagrangianInput::of(v),
          .fraction = w.fraction,
          .next = w.next,
          .wall_pressure = w.pressure,
          .open = w.open,
          .flow = w.flow,
          .covered = w.covered,
          .cell = {w.mass, w.momentum, w.inverse_mass, w.donor_velocity, w.base_mask, w.gives_old,
                   w.remap_mask}};
}

// As amounts per volume of the cell: M, P; the state of the fluid follows from M', P', E'.
UpdateInput UpdateInput::of(const SchemeVariables& v) {
  const WallVariables& w = v.walls;
  ice::UpdateInput amounts = ice::UpdateInput::of(v);
  amounts.amounts.rho = w.mass;
  amounts.amounts.momentum = w.momentum;
  amounts.rho = w.after.rho;
  amounts.momentum = w.after.momentum;
  amounts.energy = w.after.energy;
  return {.amounts = amounts,
          .velocity_L = v.velocity_L,
          .fraction = w.fraction,
          .next = w.next,
          .rho = v.rho,
          .momentum = v.momentum,
          .energy = v.energy,
          .fraction_new = w.fraction_new,
          .rho_new = v.rho_new,
          .momentum_new = v.momentum_new,
          .energy_new = v.energy_new};
}

ScalarWallsInput ScalarWallsInput::of(const SchemeVariables& v) {
  return {.scalars = v.scalars,
          .fraction = v.walls.fraction,
          .next = v.walls.next,
          .open = v.walls.open,
          .covered = v.walls.covered};
}

MaterialSharesInput MaterialSharesInput::of(const mixture::Variables& v,
                                            const MaterialVariables& x) {
  const SchemeVariables& c = v.common;
  return {.state = mixture::MaterialStates::of(v),
          .slip = v.slip.slip,
          .fraction = c.walls.fraction,
          .next = c.walls.next,
          .pressure = c.pressure,
          .inverse_rho = c.inverse_rho,
          .energy_star = c.energy_star,
          .energy = c.energy,
          .flow = c.walls.flow,
          .volume_L = x.volume_L,
          .energy_L = x.energy_L};
}

CutFluxInput CutFluxInput::of(const mixture::Variables& v, const MaterialVariables& x) {
  const WallVariables& w = v.common.walls;
  return {.state = mixture::MaterialStates::of(v),
          .cut = v.cut,
          .fraction = w.fraction,
          .inverse_J = v.common.inverse_J,
          .pure = v.pure,
          .donor_velocity = w.donor_velocity,
          .energy_L = x.energy_L,
          .gives_old = w.gives_old,
          .flow = w.flow,
          .whole = {x.whole_flux, x.full_face_material_flux, x.full_face_velocity},
          .passed_on = x.passed_on,
          .flux = v.common.flux,
          .flux_of_each = v.flux,
          .material_velocity = v.common.material_velocity};
}

// The remap of a whole cell moves l u_f of the cell's volume, differences of the old state count
// (1 - nu)/J, a share |F|/rho of the mass leaves: here l w_f, (1 - nu) V/V_L, |F|/(rho V).
RemapFluxInput full_cell_remap(const SchemeVariables& v, int axis) {
  RemapFluxInput remap = RemapFluxInput::of(v);
  remap.face_velocity = v.walls.flow;
  remap.inverse_rho = v.walls.inverse_mass;
  remap.donors.velocity_L = v.walls.donor_velocity;
  remap.mask = v.walls.remap_mask[axis];
  return remap;
}

}  // namespace sluice::ice::cut_cells
