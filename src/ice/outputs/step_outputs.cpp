// Saved labels that only exist inside a step.
#include "ice/fluid/labels.hpp"
#include "ice/outputs/step_labels.hpp"
#include "ice/outputs/transport_labels.hpp"
#include "ice/sources/source_tasks.hpp"
#include "ice/step/cell_sums.hpp"
#include "ice/step/effect_ids.hpp"
#include "ice/step/laws_of_cells.hpp"

namespace sluice::ice {
namespace {

// p(new state) - p(old state).
void pressure_change_task(TaskList& list, const OutputInput& v, const SchemeOptions& o) {
  const Label label = labels().pressure_change;
  if (o.materials.mixture)
    return save_values(list, label, 0, effect_saved_intermediates,
                       std::array{v.pressure, v.new_pressure},
                       [](const Row&, const auto& q, int i) { return q[1][i] - q[0][i]; });
  TaskBuilder task = list.task("save " + label.name(), effect_saved_intermediates);
  const In p = task.read(v.pressure), rho = task.read(v.after.rho), E = task.read(v.after.energy);
  const LawsOfCells laws(task, list, o, LawsOfCells::When::new_state);
  const Out out = task.write(list.output(label, 0));
  task.kernel([=](const Row& row) {
    const double* before = row(p);
    double* change = row(out);
    laws.of_one(row).pressure(row.count(), row(rho), row(E), change);
    for (int i = 0; i < row.count(); ++i) change[i] -= before[i];
  });
}

// A face label along a direction that is not active: nothing flows, the pressure is the cell's.
void inactive_face_task(TaskList& list, const OutputInput& v, const SchemeOptions& o, int d,
                        Label label, bool pressure) {
  TaskBuilder task = list.task("save " + label.name(), effect_saved_intermediates);
  int carried = -1;
  for (int c = o.grid.axes.count; c < o.grid.components; ++c)
    if (o.grid.direction[c] == d) carried = c;
  const In in = task.read(pressure ? v.pressure : v.velocity);
  const Out out = task.write(list.output(label, 0));
  task.kernel([=](const Row& row) {
    double* to = row(out);
    const double* from = pressure ? row(in) : carried >= 0 ? row(in, carried) : nullptr;
    for (int i = 0; i < row.count(); ++i) to[i] = from != nullptr ? from[i] : 0.0;
  });
}

}  // namespace

void declare_step_outputs(TaskList& list, const OutputInput& v, const SchemeOptions& o,
                          const MaterialsOfStep& materials) {
  const Labels& l = labels();
  const auto save = [&](Label label, VariableId from) {
    save_copy(list, label, 0, effect_saved_intermediates, from);
  };
  save(l.equilibrium_pressure, v.pressure);
  if (o.scheme.internal_energy_form)
    save(l.pressure_change, v.pressure_change);
  else
    pressure_change_task(list, v, o);
  declare_phase_labels(list, v, o, materials, effect_saved_intermediates);
  declare_motion_labels(list, v, o, materials, effect_saved_intermediates);
  declare_face_labels(list, v, o, materials, effect_saved_intermediates);
  declare_transport_outputs(list, v, o);
  declare_source_pressure(list, v, o, materials, effect_saved_intermediates);
  declare_source_labels(list, o.forces.sources != nullptr ? v.source_change : v.rho, o,
                        effect_saved_intermediates);
  for (int d = 0; d < 3; ++d) {
    const int axis = axis_along(o, d);
    if (axis < 0) {
      inactive_face_task(list, v, o, d, l.face_velocity[d], false);
      inactive_face_task(list, v, o, d, l.face_velocity_exchanged[d], false);
      inactive_face_task(list, v, o, d, l.face_pressure[d], true);
      continue;
    }
    save(l.face_velocity[d], v.face_velocity[axis]);
    save(l.face_velocity_exchanged[d], v.face_velocity[axis]);
    save(l.face_pressure[d], v.face_pressure[axis]);
  }
}

}  // namespace sluice::ice
