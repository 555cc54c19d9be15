// Trapezoid filters over one, two and three axes.
#include "ice/transport/test_filter.hpp"

namespace sluice::ice {
namespace {

void add_along(const TransportTask& t, VariableId from, VariableId to, int components, int axis,
               const std::string& name) {
  TaskBuilder task = t.list.task(t.name + "filter " + name, t.effect);
  const In in = task.read(from, Stencil::along(t.options.grid.axes.direction[axis], 1, 1));
  const Out out = task.write(to);
  task.kernel([=](const Row& row) {
    const int n = row.count();
    for (int c = 0; c < components; ++c) {
      const double* __restrict minus = row(in, c, axis, -1);
      const double* __restrict here = row(in, c);
      const double* __restrict plus = row(in, c, axis, 1);
      double* __restrict q = row(out, c);
      for (int i = 0; i < n; ++i) q[i] = 0.25 * ((minus[i] + plus[i]) + 2.0 * here[i]);
    }
  });
}

void add_in_plane(const TransportTask& t, VariableId from, VariableId to, int components,
                  const std::string& name) {
  TaskBuilder task = t.list.task(t.name + "filter " + name, t.effect);
  Stencil around = Stencil::along(t.options.grid.axes.direction[0], 1, 1);
  around.low[t.options.grid.axes.direction[1]] = around.high[t.options.grid.axes.direction[1]] = 1;
  const In in = task.read(from, around);
  const Out out = task.write(to);
  task.kernel([=](const Row& row) {
    const int n = row.count();
    for (int c = 0; c < components; ++c) {
      const double* __restrict here = row(in, c);
      const double *xm = row(in, c, 0, -1), *xp = row(in, c, 0, 1);
      const double *ym = row(in, c, 1, -1), *yp = row(in, c, 1, 1);
      const double *mm = row.at_corner(in, c, 0, -1, 1, -1), *pp = row.at_corner(in, c, 0, 1, 1, 1);
      const double *mp = row.at_corner(in, c, 0, -1, 1, 1), *pm = row.at_corner(in, c, 0, 1, 1, -1);
      double* __restrict q = row(out, c);
      for (int i = 0; i < n; ++i) {
        const double corners = (mm[i] + pp[i]) + (mp[i] + pm[i]);
        const double sides = (xm[i] + xp[i]) + (ym[i] + yp[i]);
        q[i] = 0.0625 * (corners + 2.0 * sides + 4.0 * here[i]);
      }
    }
  });
}

}  // namespace

VariableId add_test_filter(const TransportTask& t, VariableId variable, int components,
                           const std::string& name) {
  const VariableId filtered = t.list.temporary(t.name + "filtered " + name, components);
  const int axes = t.options.grid.axes.count;
  if (axes == 1) {
    add_along(t, variable, filtered, components, 0, name);
    return filtered;
  }
  add_in_plane(t, variable, filtered, components, name);
  if (axes == 2) return filtered;
  const VariableId all = t.list.temporary(t.name + "filtered twice " + name, components);
  add_along(t, filtered, all, components, 2, name + " along the last axis");
  return all;
}

}  // namespace sluice::ice
