// Scalars where solids are. Their tasks (scalars/) are those of whole cells, told that
//
//   M = rho V is the mass of a cell (nothing in a dry one), rho that of what spreads,
//   slopes count along an axis where no solid cuts the cell and cut_cells/apertures.cpp lets them,
//   through 1 - a of a face between cells with fluid passes what spreads.
//
// A touched donor therefore gives its q. Cells without solids around them get the bits of the
// ordinary graph.
#include <string>

#include "ice/cut_cells/variables.hpp"

namespace sluice::ice::cut_cells {

void declare_scalar_walls(TaskList& list, const SchemeOptions& o, SchemeVariables& v) {
  ScalarVariables& s = v.scalars;
  if (s.each.empty()) return;
  s.walls.has_cut_cells = true;
  s.walls.cut = list.temporary("cells with scalars that solids touch");
  for (ScalarVariables::Each& e : s.each) {
    e.density = e.mass;
    e.mass = list.temporary("mass with scalar " + std::to_string(e.index) + " in the cell");
  }
  if (o.scheme.second_order) s.walls.slopes = list.temporary("weight of slopes of scalars");
  for (int a = 0; a < o.grid.axes.count; ++a) {
    const std::string axis = " of axis " + std::to_string(a);
    if (o.scheme.second_order)
      s.walls.axis_slopes[a] = list.temporary("weight of slopes of scalars" + axis);
    if (s.diffusive)
      s.walls.open_share[a] = list.temporary("open share" + axis, 1, o.grid.axes.direction[a]);
  }
}

namespace {

void add_cells(TaskList& list, const ScalarWallsInput& v, const SchemeOptions& o, int effect) {
  TaskBuilder task = list.task("cells with scalars beside solids", effect);
  const ScalarVariables& s = v.scalars;
  const In fraction = task.read(v.fraction), next = task.read(v.next);
  std::vector<In> density;
  std::vector<Out> mass;
  for (const ScalarVariables::Each& e : s.each) {
    density.push_back(task.read(e.density));
    mass.push_back(task.write(e.mass));
  }
  const Out cut = task.write(s.walls.cut);
  task.kernel([=](const Row& row) {
    const int n = row.count();
    const double *theta = row(fraction), *after = row(next);
    double* __restrict here = row(cut);
#pragma GCC ivdep
    for (int i = 0; i < n; ++i) here[i] = ((theta[i] > 0) | (after[i] > 0)) ? 1.0 : 0.0;
    for (std::size_t k = 0; k < mass.size(); ++k) {
      const double* rho = row(density[k]);
      double* M = row(mass[k]);
      for (int i = 0; i < n; ++i) M[i] = rho[i] * (1.0 - theta[i]);
    }
  });
  if (!o.scheme.second_order) return;
  TaskBuilder weights = list.task("weight of slopes of scalars", effect);
  const In touches = weights.read(s.walls.cut), open = weights.read(v.open);
  const Out whole = weights.write(s.walls.slopes);
  std::array<Out, 3> along;
  for (int a = 0; a < o.grid.axes.count; ++a) along[a] = weights.write(s.walls.axis_slopes[a]);
  weights.kernel([=, axes = o.grid.axes.count](const Row& row) {
    const int n = row.count();
    const double* here = row(touches);
    double* all = row(whole);
    for (int i = 0; i < n; ++i) all[i] = 1.0 - here[i];
    for (int a = 0; a < axes; ++a) {
      const double* o_a = row(open, a);
      double* to = row(along[a]);
      for (int i = 0; i < n; ++i) to[i] = (1.0 - here[i]) * o_a[i];
      for (int i = 0; i < n; ++i) all[i] *= o_a[i];
    }
  });
}

}  // namespace

void add_scalar_walls(TaskList& list, const ScalarWallsInput& v, const SchemeOptions& o,
                      int effect) {
  if (v.scalars.each.empty()) return;
  add_cells(list, v, o, effect);
  for (int axis = 0; axis < o.grid.axes.count && v.scalars.diffusive; ++axis) {
    TaskBuilder task = list.task("open share with scalars " + std::to_string(axis), effect);
    const In fraction = task.read(v.fraction, Stencil::along(o.grid.axes.direction[axis], 1, 0));
    const In covered = task.read(v.covered[axis]);
    const Out share = task.write(v.scalars.walls.open_share[axis]);
    task.kernel([=](const Row& row) {
      const double *ta = row(fraction, 0, axis, -1), *tb = row(fraction), *a = row(covered);
      double* __restrict to = row(share);
      const int count = row.count();
#pragma GCC ivdep
      for (int i = 0; i < count; ++i) {
        const double open = 1.0 - a[i];
        to[i] = ((ta[i] < 1) & (tb[i] < 1)) ? open : 0.0;
      }
    });
  }
}

}  // namespace sluice::ice::cut_cells
