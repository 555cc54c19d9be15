#include "ice/cut_cells/variables.hpp"

#include <string>

#include "ice/fluid/labels.hpp"

namespace sluice::ice::cut_cells {

void declare_variables(TaskList& list, const SchemeOptions& o, SchemeVariables& v) {
  const Labels& l = labels();
  const int C = o.grid.components, D = o.grid.axes.count;
  WallVariables& w = v.walls;
  w.fraction = list.old_state(l.solid_fraction, 0, 1);
  w.fraction_new = list.new_state(l.solid_fraction, 0, 1);
  w.next = list.old_state(l.solid_fraction_next, 0, 1);
  w.pressure = list.old_state(l.wall_pressure, 0, 1);
  for (int a = 0; a < D; ++a) {
    const int d = o.grid.axes.direction[a];
    const std::string axis = " of axis " + std::to_string(a);
    w.covered[a] = list.old_state(l.covered[d], 0, 1);
    w.mean_covered[a] = list.old_state(l.mean_covered[d], 0, 1);
    w.swept[a] = list.old_state(l.swept[d], 0, 1);
    w.solid_velocity[a] = list.old_state(l.solid_face_velocity[d], 0, 1);
    w.fluid_velocity[a] = list.temporary("velocity between fluid cells" + axis, 1, d);
    w.fluid_pressure[a] = list.temporary("pressure between fluid cells" + axis, 1, d);
    w.raw_flow[a] = list.temporary("volume flow before closing" + axis, 1, d);
    w.flow[a] = list.temporary("volume flow" + axis, 1, d);
    if (o.transport.viscous)
      w.whole_stress[a] = list.temporary("stress of open faces" + axis, C, d);
    if (o.transport.conducting)
      w.whole_heat_flux[a] = list.temporary("heat flux of open faces" + axis, 1, d);
    w.remap_mask[a] = list.temporary("weight of slopes" + axis);
  }
  w.open = list.temporary("where slopes count", D);
  w.outflow = list.temporary("outflow of cells without fluid");
  w.mass = list.temporary("mass in the cell");
  w.momentum = list.temporary("momentum in the cell", C);
  w.inverse_mass = list.temporary("1/mass in the cell");
  w.donor_velocity = list.temporary("velocity of donors", C);
  w.gives_old = list.temporary("donors that give their old state");
  w.base_mask = list.temporary("weight of transverse slopes");
  w.after.rho = list.temporary("density after the step");
  w.after.momentum = list.temporary("momentum after the step", C);
  w.after.energy = list.temporary("energy after the step");
  if (!o.materials.mixture) v.after = w.after;
}

}  // namespace sluice::ice::cut_cells
