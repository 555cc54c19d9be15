// Labels on faces: temperature and share of each material, gradient of the pressure.
#include <algorithm>

#include "ice/fluid/labels.hpp"
#include "ice/outputs/step_labels.hpp"

namespace sluice::ice {
namespace {

// T of the cells, 0 where the material is absent.
VariableId declare_temperature(TaskList& list, const SchemeOptions& o,
                               const MaterialsOfStep& materials, const MaterialOfStep& m,
                               int effect) {
  const std::string name = "temperature of material " + std::to_string(m.index);
  const VariableId temperature = list.temporary(name);
  TaskBuilder task = list.task(name, effect);
  const In mass = task.read(m.mass), volume = task.read(m.volume), energy = task.read(m.energy);
  const In fraction = task.read(materials.f.value_or(m.mass));
  const Out out = task.write(temperature);
  task.kernel([=, thermometer = temperature_function(m, o)](const Row& row) {
    const double *M = row(mass), *V = row(volume), *E = row(energy), *f = row(fraction);
    double* T = row(out);
    for (int i = 0; i < row.count(); ++i)
      T[i] = M[i] > 0.0 ? thermometer.at(M[i], V[i], E[i], f[i]) : 0.0;
  });
  return temperature;
}

// (M_a T_a + M_b T_b)/(M_a + M_b); across a direction that is no dimension the cell's own.
void save_temperature(TaskList& list, const SchemeOptions& o, const MaterialOfStep& m,
                      VariableId temperature, int d, int effect) {
  const Label label = labels().face_temperature[d];
  TaskBuilder task = list.task("save " + label.name(), effect);
  const int axis = axis_along(o, d);
  const Stencil both = axis >= 0 ? Stencil::along(d, 1, 0) : Stencil::point();
  const In mass = task.read(m.mass, both), T = task.read(temperature, both);
  const Out out = task.write(list.output(label, m.index));
  task.kernel([=](const Row& row) {
    const int along = axis >= 0 ? axis : 0, below = axis >= 0 ? -1 : 0;
    const double *Ma = row(mass, 0, along, below), *Mb = row(mass);
    const double *Ta = row(T, 0, along, below), *Tb = row(T);
    double* to = row(out);
    for (int i = 0; i < row.count(); ++i) {
      const double M = Ma[i] + Mb[i];
      to[i] = M > 0.0 ? (Ma[i] * Ta[i] + Mb[i] * Tb[i]) / M : 0.0;
    }
  });
}

void save_pressure_gradient(TaskList& list, const OutputInput& v, const SchemeOptions& o, int d,
                            int effect) {
  const Label label = labels().face_pressure_gradient[d];
  TaskBuilder task = list.task("save " + label.name(), effect);
  const int axis = axis_along(o, d);
  const In p = task.read(v.pressure, axis >= 0 ? Stencil::along(d, 1, 0) : Stencil::point());
  const Out out = task.write(list.output(label, 0));
  task.kernel([=](const Row& row) {
    double* to = row(out);
    std::fill_n(to, row.count(), 0.0);
    if (axis < 0) return;
    const double *low = row(p, 0, axis, -1), *high = row(p);
    for (int i = 0; i < row.count(); ++i) to[i] = (high[i] - low[i]) / row.step().spacing[d];
  });
}

}  // namespace

int axis_along(const SchemeOptions& o, int direction) {
  for (int a = 0; a < o.grid.axes.count; ++a)
    if (o.grid.axes.direction[a] == direction) return a;
  return -1;
}

void declare_face_labels(TaskList& list, const OutputInput& v, const SchemeOptions& o,
                         const MaterialsOfStep& materials, int effect) {
  for (const MaterialOfStep& m : materials.each) {
    const VariableId temperature = declare_temperature(list, o, materials, m, effect);
    for (int d = 0; d < 3; ++d) {
      save_temperature(list, o, m, temperature, d, effect);
      const int axis = axis_along(o, d);
      const auto share = axis >= 0 ? m.passing[axis] : std::nullopt;
      save_copy(list, labels().face_volume_fraction[d], m.index, effect, share.value_or(m.volume));
    }
  }
  for (int d = 0; d < 3; ++d) save_pressure_gradient(list, v, o, d, effect);
}

}  // namespace sluice::ice
