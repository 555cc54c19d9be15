// Saved labels of the Lagrangian phase of each material.
#include "ice/labels.hpp"
#include "ice/mixture/runs.hpp"
#include "ice/mixture/variables.hpp"

namespace sluice::ice::mixture {

void declare_lagrangian_labels(TaskList& list, const Variables& v, const SchemeOptions& o,
                               int effect) {
  for (int m = 0; m < static_cast<int>(o.fluids.size()); ++m) {
    TaskBuilder task = list.task("save " + labels().lagrangian_energy.name(), effect);
    const In pure = task.read(v.pure), own = task.read(v.energy_L),
             alone = task.read(v.common.energy_star);
    const Out energy = task.write(list.output(labels().lagrangian_energy, m));
    task.kernel([=](const Row& row) {
      const Vec3 dx = row.step().spacing;
      const double volume = dx.x * dx.y * dx.z;
      double* E = row(energy);
      pick_row(row.count(), row(pure), m, row(own, m), row(alone), E);
      for (int i = 0; i < row.count(); ++i) E[i] *= volume;
    });
  }
}

}  // namespace sluice::ice::mixture
