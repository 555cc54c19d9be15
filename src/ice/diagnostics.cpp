// Saved labels that are functions of a state alone, as tasks that read it as old state.
//
// Gradients are central differences, (q_{i+1} - q_{i-1})/(2 dx), along active directions; next to
// the boundary they use the ghost states.
#include <cmath>

#include "ice/ice.hpp"
#include "ice/labels.hpp"

namespace sluice::ice {
namespace {

struct Primitives {
  VariableId rho, momentum, energy;            // the state
  VariableId velocity, pressure, temperature;  // temporaries
};

Primitives declare_primitives(TaskList& list, const SchemeOptions& o) {
  const Labels& l = labels();
  Primitives p;
  p.rho = list.old_state(l.mass, 0, 1);
  p.momentum = list.old_state(l.momentum, 0, o.components);
  p.energy = list.old_state(l.energy, 0, 1);
  p.velocity = list.temporary("velocity", 3);
  p.pressure = list.temporary("pressure");
  p.temperature = list.temporary("temperature");
  TaskBuilder task = list.task("primitives of the state", effect_diagnostics);
  const In rho = task.read(p.rho), momentum = task.read(p.momentum), energy = task.read(p.energy);
  const Out velocity = task.write(p.velocity), pressure = task.write(p.pressure),
            temperature = task.write(p.temperature);
  task.kernel([=](const Row& row) {
    const int n = row.count();
    const double* r = row(rho);
    const double* E = row(energy);
    double* pressures = row(pressure);
    double* temperatures = row(temperature);
    for (int i = 0; i < n; ++i) {
      pressures[i] = o.gas.pressure(r[i], E[i]);
      temperatures[i] = o.gas.temperature(r[i], E[i]);
    }
    for (int d = 0; d < 3; ++d) {
      double* u = row(velocity, d);
      for (int i = 0; i < n; ++i) u[i] = 0.0;
    }
    for (int c = 0; c < o.components; ++c) {
      const double* m = row(momentum, c);
      double* u = row(velocity, o.direction[static_cast<std::size_t>(c)]);
      for (int i = 0; i < n; ++i) u[i] = m[i] / r[i];
    }
  });
  return p;
}

// A label that is a function of rho and p in the same cell.
template <class F>
void pointwise(TaskList& list, const Primitives& p, Label label, F f) {
  TaskBuilder task = list.task("compute " + label.name(), effect_diagnostics);
  const In rho = task.read(p.rho), pressure = task.read(p.pressure);
  const Out out = task.write(list.output(label, 0));
  task.kernel([=](const Row& row) {
    const double* r = row(rho);
    const double* q = row(pressure);
    double* to = row(out);
    for (int i = 0; i < row.count(); ++i) to[i] = f(r[i], q[i]);
  });
}

void copy(TaskList& list, VariableId from, int components, Label label) {
  TaskBuilder task = list.task("compute " + label.name(), effect_diagnostics);
  const In in = task.read(from);
  const Out out = task.write(list.output(label, 0));
  task.kernel([=](const Row& row) {
    for (int c = 0; c < components; ++c) {
      const double* q = row(in, c);
      double* to = row(out, c);
      for (int i = 0; i < row.count(); ++i) to[i] = q[i];
    }
  });
}

void mach(TaskList& list, const Primitives& p, const SchemeOptions& o) {
  TaskBuilder task = list.task("compute mach", effect_diagnostics);
  const In rho = task.read(p.rho), pressure = task.read(p.pressure), u = task.read(p.velocity);
  const Out out = task.write(list.output(labels().mach, 0));
  task.kernel([=](const Row& row) {
    const double* r = row(rho);
    const double* q = row(pressure);
    const double* v[3] = {row(u, 0), row(u, 1), row(u, 2)};
    double* to = row(out);
    for (int i = 0; i < row.count(); ++i)
      to[i] = std::sqrt(v[0][i] * v[0][i] + v[1][i] * v[1][i] + v[2][i] * v[2][i]) /
              o.gas.sound_speed(r[i], q[i]);
  });
}

// Magnitude of the gradient of a cell variable.
void gradient(TaskList& list, VariableId of, Label label, const SchemeOptions& o) {
  TaskBuilder task = list.task("compute " + label.name(), effect_diagnostics);
  const In in = task.read(of, Stencil::box(1));
  const Out out = task.write(list.output(label, 0));
  task.kernel([=](const Row& row) {
    double* to = row(out);
    const double* low[3];
    const double* high[3];
    for (int a = 0; a < o.axes.count; ++a) {
      low[a] = row(in, 0, a, -1);
      high[a] = row(in, 0, a, 1);
    }
    for (int i = 0; i < row.count(); ++i) {
      double sum = 0;
      for (int a = 0; a < o.axes.count; ++a) {
        const double slope =
            (high[a][i] - low[a][i]) / (2.0 * row.step().spacing[o.axes.direction[a]]);
        sum += slope * slope;
      }
      to[i] = std::sqrt(sum);
    }
  });
}

void divergence(TaskList& list, const Primitives& p, const SchemeOptions& o) {
  TaskBuilder task = list.task("compute mag_div_vel_CC", effect_diagnostics);
  const In u = task.read(p.velocity, Stencil::box(1));
  const Out out = task.write(list.output(labels().divergence_velocity, 0));
  task.kernel([=](const Row& row) {
    double* to = row(out);
    for (int i = 0; i < row.count(); ++i) {
      double sum = 0;
      for (int a = 0; a < o.axes.count; ++a) {
        const int d = o.axes.direction[a];
        const double slope =
            (row(u, d, a, 1)[i] - row(u, d, a, -1)[i]) / (2.0 * row.step().spacing[d]);
        sum += slope * slope;
      }
      to[i] = std::sqrt(sum);
    }
  });
}

void vorticity(TaskList& list, const Primitives& p, const SchemeOptions& o) {
  TaskBuilder task = list.task("compute vorticity", effect_diagnostics);
  const In u = task.read(p.velocity, Stencil::box(1));
  const Out out = task.write(list.output(labels().vorticity, 0));
  int axis_of[3] = {-1, -1, -1};
  for (int a = 0; a < o.axes.count; ++a) axis_of[o.axes.direction[a]] = a;
  const int x = axis_of[0], y = axis_of[1], z = axis_of[2];
  task.kernel([=](const Row& row) {
    const Vec3 dx = row.step().spacing;
    // d u_component / d x_direction at cell i; zero along inactive directions
    auto slope = [&](int component, int direction, int axis, int i) {
      if (axis < 0) return 0.0;
      return (row(u, component, axis, 1)[i] - row(u, component, axis, -1)[i]) /
             (2.0 * dx[direction]);
    };
    for (int i = 0; i < row.count(); ++i) {
      row(out, 0)[i] = slope(2, 1, y, i) - slope(1, 2, z, i);
      row(out, 1)[i] = slope(0, 2, z, i) - slope(2, 0, x, i);
      row(out, 2)[i] = slope(1, 0, x, i) - slope(0, 1, y, i);
    }
  });
}

// 1 where the gradient of a criterion's variable exceeds its threshold.
void refine_flag(TaskList& list, const Primitives& p, const SchemeOptions& o, const IceScene& ice) {
  struct Test {
    In in;
    int components;
    double threshold;
  };
  TaskBuilder task = list.task("compute refineFlag", effect_diagnostics);
  std::vector<Test> tests;
  const Stencil around = Stencil::box(1);
  for (const RefinementCriterion& c : ice.criteria) {
    if (c.label == "rho_CC") tests.push_back({task.read(p.rho, around), 1, c.value});
    if (c.label == "temp_CC") tests.push_back({task.read(p.temperature, around), 1, c.value});
    if (c.label == "press_CC") tests.push_back({task.read(p.pressure, around), 1, c.value});
    if (c.label == "vel_CC") tests.push_back({task.read(p.velocity, around), 3, c.value});
  }
  const Out out = task.write(list.output(labels().refine_flag, 0));
  task.kernel([=](const Row& row) {
    double* flag = row(out);
    for (int i = 0; i < row.count(); ++i) flag[i] = 0.0;
    for (const Test& t : tests)
      for (int i = 0; i < row.count(); ++i) {
        double sum = 0;
        for (int q = 0; q < t.components; ++q)
          for (int a = 0; a < o.axes.count; ++a) {
            const double slope = (row(t.in, q, a, 1)[i] - row(t.in, q, a, -1)[i]) /
                                 (2.0 * row.step().spacing[o.axes.direction[a]]);
            sum += slope * slope;
          }
        if (std::sqrt(sum) > t.threshold) flag[i] = 1.0;
      }
  });
}

}  // namespace

void declare_diagnostic_outputs(TaskList& list, const SchemeOptions& o, const IceScene& ice) {
  const Labels& l = labels();
  const Primitives p = declare_primitives(list, o);
  const eos::IdealGas gas = o.gas;
  const double mu = o.viscosity;
  copy(list, p.rho, 1, l.rho);
  copy(list, p.rho, 1, l.rho_micro);
  copy(list, p.rho, 1, l.sum_rho);
  copy(list, p.velocity, 3, l.velocity);
  copy(list, p.temperature, 1, l.temperature);
  copy(list, p.pressure, 1, l.pressure);
  pointwise(list, p, l.specific_volume, [](double rho, double) { return 1.0 / rho; });
  pointwise(list, p, l.volume_fraction, [](double, double) { return 1.0; });
  pointwise(list, p, l.sound_speed,
            [gas](double rho, double pressure) { return gas.sound_speed(rho, pressure); });
  pointwise(list, p, l.compressibility, [gas](double rho, double pressure) {
    const double c = gas.sound_speed(rho, pressure);
    return 1.0 / (rho * c * c);
  });
  pointwise(list, p, l.viscosity, [mu](double, double) { return mu; });
  pointwise(list, p, l.thermal_conductivity, [](double, double) { return 0.0; });
  pointwise(list, p, l.gamma, [gas](double, double) { return gas.gamma; });
  pointwise(list, p, l.specific_heat, [gas](double, double) { return gas.specific_heat; });
  mach(list, p, o);
  gradient(list, p.rho, l.gradient_rho, o);
  gradient(list, p.temperature, l.gradient_temperature, o);
  gradient(list, p.pressure, l.gradient_pressure, o);
  pointwise(list, p, l.gradient_volume_fraction, [](double, double) { return 0.0; });
  divergence(list, p, o);
  vorticity(list, p, o);
  refine_flag(list, p, o, ice);
}

}  // namespace sluice::ice
