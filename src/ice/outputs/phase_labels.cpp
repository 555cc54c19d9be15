// Mass, volume and energy of each material in the Lagrangian phase, and the rates of its
// temperature.
#include <algorithm>

#include "ice/closure/traces.hpp"
#include "ice/fluid/labels.hpp"
#include "ice/outputs/step_labels.hpp"
#include "ice/step/cell_sums.hpp"
#include "ice/step/effect_ids.hpp"
#include "ice/step/laws_of_cells.hpp"

namespace sluice::ice {
namespace {

// J - 1 = sum_d l_d (u_f+ - u_f-).
VariableId declare_dilation(TaskList& list, const OutputInput& v, const SchemeOptions& o,
                            int effect) {
  const VariableId dilation = list.temporary("dilation");
  TaskBuilder task = list.task("dilation", effect);
  std::array<In, 3> velocity;
  for (int axis = 0; axis < o.grid.axes.count; ++axis) {
    velocity[axis] =
        task.read(v.face_velocity[axis], Stencil::along(o.grid.axes.direction[axis], 0, 1));
  }
  const Out out = task.write(dilation);
  task.kernel([=, axes = o.grid.axes](const Row& row) {
    double* to = row(out);
    std::fill_n(to, row.count(), 0.0);
    for (int axis = 0; axis < axes.count; ++axis) {
      const In face = velocity[axis];
      const double *low = row(face), *high = row(face, 0, axis, 1);
      const double l = row.step().dt / row.step().spacing[axes.direction[axis]];
      for (int i = 0; i < row.count(); ++i) to[i] += l * (high[i] - low[i]);
    }
  });
  return dilation;
}

// The temperature before advection and at the end of the step, each less that of the start, by dt.
void declare_heating(TaskList& list, const OutputInput& v, const SchemeOptions& o,
                     const MaterialsOfStep& materials, const MaterialOfStep& m, VariableId dilation,
                     int effect) {
  const VariableId f = materials.f.value_or(m.mass), f_new = materials.f_new.value_or(m.mass_new);
  const TemperatureFunction T = temperature_function(m, o);
  save_values(list, labels().lagrangian_heating, m.index, effect,
              std::array{m.mass, m.volume, m.energy, m.energy_L, dilation, f, v.rho},
              [T](const Row& row, const auto& q, int i) {
                const double M = q[0][i], V = q[1][i];
                if (!mixture::has_temperature(M, q[6][i])) return 0.0;
                const double before = T.at(M, V, q[2][i], q[5][i]);
                return (T.at(M, V * (1.0 + q[4][i]), q[3][i], q[5][i]) - before) / row.step().dt;
              });
  save_values(list, labels().temperature_rate, m.index, effect,
              std::array{m.mass, m.volume, m.energy, f, v.rho, m.mass_new, m.volume_new,
                         m.energy_new, f_new, materials.density_new},
              [T](const Row& row, const auto& q, int i) {
                using mixture::has_temperature;
                if (!has_temperature(q[0][i], q[4][i]) || !has_temperature(q[5][i], q[9][i]))
                  return 0.0;
                const double before = T.at(q[0][i], q[1][i], q[2][i], q[3][i]);
                return (T.at(q[5][i], q[6][i], q[7][i], q[8][i]) - before) / row.step().dt;
              });
}

}  // namespace

double TemperatureFunction::at(double M, double V, double E, double f) const {
  return gas != nullptr ? E / (M * gas->specific_heat(f)) : fluid.temperature(M / V, E / V);
}

TemperatureFunction temperature_function(const MaterialOfStep& m, const SchemeOptions& o) {
  const bool composed = is_mixed(o, m.index);
  return {m.fluid, composed ? o.materials.mixed : nullptr};
}

MaterialsOfStep material_alone(TaskList& list, const MaterialAloneInput& v,
                               const SchemeOptions& o) {
  const VariableId all = list.temporary("share of the one material");
  TaskBuilder task = list.task("share of the one material", effect_saved_intermediates);
  static_cast<void>(task.read(v.rho));  // a task must read something
  const Out out = task.write(all);
  task.kernel([=](const Row& row) { std::fill_n(row(out), row.count(), 1.0); });
  MaterialsOfStep materials;
  materials.each.push_back({o.materials.index,
                            o.materials.fluid,
                            v.rho,
                            all,
                            v.energy,
                            v.after.rho,
                            all,
                            v.after.energy,
                            v.energy_star,
                            {},
                            {}});
  materials.density_new = v.after.rho;
  if (o.materials.mixed != nullptr) {
    materials.f = old_fraction(list, o);
    materials.f_new = new_fraction(list, o);
  }
  return materials;
}

void declare_phase_labels(TaskList& list, const OutputInput& v, const SchemeOptions& o,
                          const MaterialsOfStep& materials, int effect) {
  const Labels& l = labels();
  const VariableId dilation = declare_dilation(list, v, o, effect);
  save_copy(list, l.dilation, 0, effect, dilation);
  const auto amount = [](const Row& row, const auto& q, int i) {
    return q[0][i] * cell_volume(row);
  };
  for (const MaterialOfStep& m : materials.each) {
    save_values(list, l.lagrangian_mass, m.index, effect, std::array{m.mass}, amount);
    save_values(list, l.lagrangian_energy, m.index, effect, std::array{m.energy_L}, amount);
    save_values(list, l.energy_before_exchange, m.index, effect, std::array{m.energy_L}, amount);
    save_values(list, l.energy_source, m.index, effect, std::array{m.energy_L, m.energy},
                [](const Row& row, const auto& q, int i) {
                  return (q[0][i] - q[1][i]) * cell_volume(row);
                });
    save_values(list, l.lagrangian_volume, m.index, effect, std::array{m.volume, dilation},
                [](const Row& row, const auto& q, int i) {
                  return q[0][i] * (1.0 + q[1][i]) * cell_volume(row);
                });
    save_values(list, l.volume_source, m.index, effect, std::array{m.volume, dilation, m.mass},
                [](const Row&, const auto& q, int i) {
                  return q[2][i] > 0.0 ? q[0][i] * q[1][i] / q[2][i] : 0.0;
                });
    declare_heating(list, v, o, materials, m, dilation, effect);
  }
}

}  // namespace sluice::ice
