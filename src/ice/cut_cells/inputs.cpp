// What the tasks beside solids take of the variables of a step.
#include "ice/cut_cells/variables.hpp"

namespace sluice::ice::cut_cells {

AperturesInput AperturesInput::of(const SchemeVariables& v) {
  return {v.mask, v.walls.fraction, v.walls.covered, v.walls.open};
}

OpenFacesInput OpenFacesInput::of(const SchemeVariables& v) {
  const WallVariables& w = v.walls;
  return {w.fraction,       w.next,           w.pressure,       w.mean_covered,  w.swept,
          w.solid_velocity, w.fluid_velocity, w.fluid_pressure, v.face_velocity, v.face_pressure,
          w.raw_flow,       w.flow,           w.outflow};
}

LagrangianInput LagrangianInput::of(const SchemeVariables& v) {
  const WallVariables& w = v.walls;
  return {v.momentum,     ice::LagrangianInput::of(v),
          w.fraction,     w.next,
          w.pressure,     w.open,
          w.flow,         w.covered,
          w.mass,         w.momentum,
          w.inverse_mass, w.donor_velocity,
          w.base_mask,    w.gives_old,
          w.remap_mask};
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
  return {amounts,  v.velocity_L,   w.fraction, w.next,         v.rho,       v.momentum,
          v.energy, w.fraction_new, v.rho_new,  v.momentum_new, v.energy_new};
}

ScalarWallsInput ScalarWallsInput::of(const SchemeVariables& v) {
  return {v.scalars, v.walls.fraction, v.walls.next, v.walls.open, v.walls.covered};
}

}  // namespace sluice::ice::cut_cells
