// Stresses on faces, and what friction and conduction bring into a cell.
#include "ice/outputs/transport_labels.hpp"

#include <algorithm>

#include "ice/fluid/labels.hpp"
#include "ice/outputs/step_labels.hpp"
#include "ice/step/effect_ids.hpp"

namespace sluice::ice {
namespace {

void clear(const Row& row, Out out, int components) {
  for (int d = 0; d < components; ++d) std::fill_n(row(out, d), row.count(), 0.0);
}

// Components by level direction; no stress on faces across a direction that is no dimension.
void face_stress_task(TaskList& list, const OutputInput& v, const SchemeOptions& o, int d) {
  const Label label = labels().face_stress[d];
  TaskBuilder task = list.task("save " + label.name(), effect_saved_intermediates);
  const int axis = axis_along(o, d);
  const bool any = o.transport.viscous && axis >= 0;
  const In in = any ? task.read(v.stress[axis]) : task.read(v.rho);
  const Out out = task.write(list.output(label, 0));
  task.kernel([=](const Row& row) {
    clear(row, out, 3);
    for (int c = 0; any && c < o.grid.components; ++c)
      std::copy_n(row(in, c), row.count(), row(out, o.grid.direction[c]));
  });
}

// V sum_d (t+ - t-)/dx_d, N.
void viscous_source_task(TaskList& list, const OutputInput& v, const SchemeOptions& o) {
  const Label label = labels().viscous_source;
  TaskBuilder task = list.task("save " + label.name(), effect_saved_intermediates);
  std::array<In, 3> stress;
  const In rho = task.read(v.rho);  // a task must read something
  for (int a = 0; o.transport.viscous && a < o.grid.axes.count; ++a)
    stress[a] = task.read(v.stress[a], Stencil::along(o.grid.axes.direction[a], 0, 1));
  const Out out = task.write(list.output(label, 0));
  static_cast<void>(rho);
  task.kernel([=](const Row& row) {
    clear(row, out, 3);
    if (!o.transport.viscous) return;
    const Vec3 dx = row.step().spacing;
    for (int c = 0; c < o.grid.components; ++c) {
      double* to = row(out, o.grid.direction[c]);
      for (int a = 0; a < o.grid.axes.count; ++a) {
        const double area = dx.x * dx.y * dx.z / dx[o.grid.axes.direction[a]];
        const In t = stress[a];
        const double *minus = row(t, c), *plus = row(t, c, a, 1);
        for (int i = 0; i < row.count(); ++i) to[i] += area * (plus[i] - minus[i]);
      }
    }
  });
}

// dt V sum_d (q- - q+)/dx_d, J.
void heat_source_task(TaskList& list, const OutputInput& v, const SchemeOptions& o) {
  const Label label = labels().heat_source;
  TaskBuilder task = list.task("save " + label.name(), effect_saved_intermediates);
  std::array<In, 3> flux;
  const In rho = task.read(v.rho);
  for (int a = 0; o.transport.conducting && a < o.grid.axes.count; ++a)
    flux[a] = task.read(v.heat_flux[a], Stencil::along(o.grid.axes.direction[a], 0, 1));
  const Out out = task.write(list.output(label, 0));
  static_cast<void>(rho);
  task.kernel([=](const Row& row) {
    clear(row, out, 1);
    if (!o.transport.conducting) return;
    const Vec3 dx = row.step().spacing;
    double* to = row(out);
    for (int a = 0; a < o.grid.axes.count; ++a) {
      const double scale = row.step().dt * dx.x * dx.y * dx.z / dx[o.grid.axes.direction[a]];
      const In q = flux[a];
      const double *minus = row(q), *plus = row(q, 0, a, 1);
      for (int i = 0; i < row.count(); ++i) to[i] += scale * (minus[i] - plus[i]);
    }
  });
}

}  // namespace

void declare_transport_outputs(TaskList& list, const OutputInput& v, const SchemeOptions& o) {
  for (int d = 0; d < 3; ++d) face_stress_task(list, v, o, d);
  viscous_source_task(list, v, o);
  heat_source_task(list, v, o);
}

}  // namespace sluice::ice
