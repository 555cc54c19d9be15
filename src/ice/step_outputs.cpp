// Saved labels that only exist inside a step.
#include "ice/cell_sums.hpp"
#include "ice/closure_rows.hpp"
#include "ice/ice.hpp"
#include "ice/labels.hpp"
#include "ice/scalars/mixed_gas.hpp"
#include "ice/sources/source_tasks.hpp"
#include "ice/step_labels.hpp"
#include "ice/transport/outputs.hpp"

namespace sluice::ice {
namespace {

void copy_row(int n, const double* __restrict from, double* __restrict to) {
  for (int i = 0; i < n; ++i) to[i] = from[i];
}

void copy_task(TaskList& list, VariableId from, Label label) {
  TaskBuilder task = list.task("save " + label.name(), effect_saved_intermediates);
  const In in = task.read(from);
  const Out out = task.write(list.output(label, 0));
  task.kernel([=](const Row& row) { copy_row(row.count(), row(in), row(out)); });
}

// p(new state) - p(old state).
void pressure_change_task(TaskList& list, const SchemeVariables& v, const SchemeOptions& o,
                          const MaterialsOfStep& materials) {
  TaskBuilder task =
      list.task("save " + labels().pressure_change.name(), effect_saved_intermediates);
  if (o.mixture) {
    const In before = task.read(v.pressure), after = task.read(v.new_pressure);
    const Out change = task.write(list.output(labels().pressure_change, 0));
    task.kernel([=](const Row& row) {
      const double *old_p = row(before), *new_p = row(after);
      double* to = row(change);
      for (int i = 0; i < row.count(); ++i) to[i] = new_p[i] - old_p[i];
    });
    return;
  }
  if (o.mixed != nullptr) {
    const In before = task.read(v.pressure), energy = task.read(v.energy_new);
    const In f = task.read(*materials.f_new);
    const Out change = task.write(list.output(labels().pressure_change, 0));
    task.kernel([=, gas = o.mixed](const Row& row) {
      const double *old_p = row(before), *E = row(energy), *x = row(f);
      double* to = row(change);
      for (int i = 0; i < row.count(); ++i) to[i] = gas->at(x[i]).ratio() * E[i] - old_p[i];
    });
    return;
  }
  const In p = task.read(v.pressure), rho = task.read(v.rho_new), E = task.read(v.energy_new);
  const Out out = task.write(list.output(labels().pressure_change, 0));
  const Fluid fluid = o.fluid;
  task.kernel([=](const Row& row) {
    const double* before = row(p);
    double* change = row(out);
    pressure_row(fluid, row.count(), row(rho), row(E), change);
    for (int i = 0; i < row.count(); ++i) change[i] -= before[i];
  });
}

// A face label along a direction that is not active: nothing flows, the pressure is the cell's.
void inactive_face_task(TaskList& list, const SchemeVariables& v, const SchemeOptions& o, int d,
                        Label label, bool pressure) {
  TaskBuilder task = list.task("save " + label.name(), effect_saved_intermediates);
  int carried = -1;
  for (int c = o.axes.count; c < o.components; ++c)
    if (o.direction[static_cast<std::size_t>(c)] == d) carried = c;
  const In in = task.read(pressure ? v.pressure : v.velocity);
  const Out out = task.write(list.output(label, 0));
  task.kernel([=](const Row& row) {
    double* to = row(out);
    const double* from = pressure ? row(in) : carried >= 0 ? row(in, carried) : nullptr;
    for (int i = 0; i < row.count(); ++i) to[i] = from != nullptr ? from[i] : 0.0;
  });
}

}  // namespace

void declare_step_outputs(TaskList& list, const SchemeVariables& v, const SchemeOptions& o,
                          const MaterialsOfStep& materials) {
  const Labels& l = labels();
  copy_task(list, v.pressure, l.equilibrium_pressure);
  if (o.classic)
    copy_task(list, v.pressure_change, l.pressure_change);
  else
    pressure_change_task(list, v, o, materials);
  declare_phase_labels(list, v, o, materials, effect_saved_intermediates);
  declare_motion_labels(list, v, o, materials, effect_saved_intermediates);
  declare_face_labels(list, v, o, materials, effect_saved_intermediates);
  declare_transport_outputs(list, v, o);
  declare_source_pressure(list, v, o, materials, effect_saved_intermediates);
  declare_source_labels(list, v, o, effect_saved_intermediates);
  for (int d = 0; d < 3; ++d) {
    const int axis = axis_along(o, d);
    if (axis < 0) {
      inactive_face_task(list, v, o, d, l.face_velocity[d], false);
      inactive_face_task(list, v, o, d, l.face_velocity_exchanged[d], false);
      inactive_face_task(list, v, o, d, l.face_pressure[d], true);
      continue;
    }
    const auto n = static_cast<std::size_t>(axis);
    copy_task(list, v.face_velocity[n], l.face_velocity[d]);
    copy_task(list, v.face_velocity[n], l.face_velocity_exchanged[d]);
    copy_task(list, v.face_pressure[n], l.face_pressure[d]);
  }
}

}  // namespace sluice::ice
