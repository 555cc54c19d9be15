// Saved labels of the Lagrangian phase of each material, and of what models do to their pressure.
#include "ice/cell_sums.hpp"
#include "ice/labels.hpp"
#include "ice/mixture/runs.hpp"
#include "ice/mixture/variables.hpp"
#include "ice/sources/source_tasks.hpp"

namespace sluice::ice::mixture {
namespace {

void energy_tasks(TaskList& list, const Variables& v, const SchemeOptions& o, Label label,
                  int effect) {
  for (int m = 0; m < static_cast<int>(o.fluids.size()); ++m) {
    TaskBuilder task = list.task("save " + label.name(), effect);
    const In pure = task.read(v.pure), own = task.read(v.energy_L),
             alone = task.read(v.common.energy_star);
    const Out energy = task.write(list.output(label, m));
    task.kernel([=](const Row& row) {
      const double volume = cell_volume(row);
      double* E = row(energy);
      pick_row(row.count(), row(pure), m, row(own, m), row(alone), E);
      for (int i = 0; i < row.count(); ++i) E[i] *= volume;
    });
  }
}

}  // namespace

void declare_lagrangian_labels(TaskList& list, const Variables& v, const SchemeOptions& o,
                               int effect) {
  energy_tasks(list, v, o, labels().lagrangian_energy, effect);
  energy_tasks(list, v, o, labels().energy_before_exchange, effect);
  declare_source_pressure(list, v.common, o, {v.mass_new, v.volume_new, v.energy_new}, effect);
}

}  // namespace sluice::ice::mixture
