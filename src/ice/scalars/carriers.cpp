// Which mass of each material with scalars passes the faces of a mixture, and how it moves there if
// it has a velocity of its own.
//
// Where both cells of a face have the same pure neighbourhood it is the total flux, of that
// material alone; elsewhere that of each material (mixture/remap_fluxes.cpp).
#include "ice/mixture/variables.hpp"
#include "ice/scalars/variables.hpp"

namespace sluice::ice::scalars {

void add_carriers(TaskList& list, const FlowOfScalars& v, const SchemeOptions& o, int effect) {
  if (!o.materials.mixture) return;
  static const char* names[] = {"mass with scalars of axis 0", "mass with scalars of axis 1",
                                "mass with scalars of axis 2"};
  for (int axis = 0; axis < o.grid.axes.count; ++axis) {
    TaskBuilder task = list.task(names[axis], effect);
    const In flux = task.read(v.flux[axis]), materials = task.read(v.material_flux[axis]);
    const In pure = task.read(v.pure, Stencil::along(o.grid.axes.direction[axis], 1, 0));
    const Out out = task.write(v.scalars.carrier[axis]);
    task.kernel([=, carried = v.scalars.materials](const Row& row) {
      const int n = row.count();
      const double* __restrict below = row(pure, 0, axis, -1);
      const double* __restrict above = row(pure);
      const double* __restrict total = row(flux, 0);
      for (std::size_t k = 0; k < carried.size(); ++k) {
        const double m = carried[k];
        const double* __restrict own =
            row(materials, mixture::component(carried[k], mixture::of_mass));
        double* __restrict to = row(out, static_cast<int>(k));
        for (int i = 0; i < n; ++i) {
          const double alone = above[i] == m ? total[i] : 0.0;
          to[i] = below[i] == above[i] && above[i] >= 0.0 ? alone : own[i];
        }
      }
    });
  }
}

namespace {

// Of each carrier its own where the neighbourhood is mixed, else the mixture's; axis -1: of cells.
void add_choice(TaskList& list, const char* name, const FlowOfScalars& v, int effect,
                const SchemeOptions& o, int axis, VariableId mixture, VariableId own,
                VariableId to) {
  TaskBuilder task = list.task(name, effect);
  const In of_all = task.read(mixture), of_each = task.read(own);
  const Stencil around = axis < 0 ? Stencil{} : Stencil::along(o.grid.axes.direction[axis], 1, 0);
  const In pure = task.read(v.pure, around);
  const Out out = task.write(to);
  task.kernel([=, carried = v.scalars.materials](const Row& row) {
    const double* below = axis < 0 ? row(pure) : row(pure, 0, axis, -1);
    const double* above = row(pure);
    const double* all = row(of_all);
    for (std::size_t k = 0; k < carried.size(); ++k) {
      const double* each = row(of_each, carried[k]);
      double* chosen = row(out, static_cast<int>(k));
      for (int i = 0; i < row.count(); ++i)
        chosen[i] = below[i] == above[i] && above[i] >= 0.0 ? all[i] : each[i];
    }
  });
}

}  // namespace

FlowOfScalars add_own_motion(TaskList& list, const FlowOfScalars& of_mixture,
                             const OwnMotionInput& own, const SchemeOptions& o, int effect) {
  FlowOfScalars v = of_mixture;
  if (v.scalars.each.empty()) return v;
  static const char* names[] = {"velocity with scalars of axis 0",
                                "velocity with scalars of axis 1",
                                "velocity with scalars of axis 2"};
  const int count = static_cast<int>(v.scalars.materials.size());
  for (int axis = 0; axis < o.grid.axes.count; ++axis) {
    v.face_velocity[axis] = list.temporary(names[axis], count, o.grid.axes.direction[axis]);
    add_choice(list, names[axis], of_mixture, effect, o, axis, of_mixture.face_velocity[axis],
               own.face_velocity[axis], v.face_velocity[axis]);
  }
  v.courant = list.temporary("outflow with scalars", count);
  add_choice(list, "outflow with scalars", of_mixture, effect, o, -1, of_mixture.courant,
             own.outflow, v.courant);
  v.velocity = own.velocity;
  return v;
}

}  // namespace sluice::ice::scalars
