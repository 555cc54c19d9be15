// Conductivity of a mixed gas, and the enthalpy that its diffusion carries.
#include "ice/transport/mixed_heat.hpp"

#include "ice/fluid/shared_mass.hpp"
#include "ice/step/laws_of_cells.hpp"
#include "models/scalars/transported_scalar.hpp"

namespace sluice::ice::scalars {

void add_conductivity(TaskList& list, VariableId conductivity, const SchemeOptions& o, int effect) {
  TaskBuilder task = list.task("conductivity of the mixture", effect);
  const LawsOfCells laws(task, list, o);
  const Out k = task.write(conductivity);
  task.kernel([=, given = o.transport.conductivity](const Row& row) {
    laws.of_one(row).conductivity(row.count(), given, row(k));
  });
}

SpreadingHandles read_spreading(TaskBuilder& task, TaskList& list, VariableId rho,
                                const SchemeOptions& o, int axis) {
  SpreadingHandles h;
  if (!(fraction_of(o).diffusivity > 0)) return h;
  const Stencil both = Stencil::along(o.grid.axes.direction[axis], 1, 0);
  h.fraction = task.read(old_fraction(list, o), both);
  h.mass = task.read(rho, both);
  return h;
}

void add_carried_enthalpy(const Row& row, const SpreadingHandles& h, In temperature,
                          const SchemeOptions& o, int axis, double* __restrict q) {
  if (h.fraction.index < 0) return;
  const int n = row.count();
  const double D = fraction_of(o).diffusivity / row.step().spacing[o.grid.axes.direction[axis]];
  const double* __restrict fa = row(h.fraction, 0, axis, -1);
  const double* __restrict fb = row(h.fraction);
  const double* __restrict Ma = row(h.mass, 0, axis, -1);
  const double* __restrict Mb = row(h.mass);
  const double* __restrict Ta = row(temperature, 0, axis, -1);
  const double* __restrict Tb = row(temperature);
  for (int i = 0; i < n; ++i) {
    const double change = o.materials.mixed->at(fa[i]).cp() - o.materials.mixed->at(fb[i]).cp();
    q[i] += D * shared_mass(Ma[i], Mb[i]) * (0.5 * (Ta[i] + Tb[i]) * change);
  }
}

}  // namespace sluice::ice::scalars
