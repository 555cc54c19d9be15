// Labels that are functions of a state alone, as tasks that read it as old state.
//
// Each is a temporary: nothing is computed unless a saved label or a criterion of refinement asks
// for it. Gradients are central differences, (q_{i+1} - q_{i-1})/(2 dx), along active directions;
// next to the boundary they use the ghost states.
#include "ice/diagnostics.hpp"

#include <cmath>
#include <stdexcept>
#include <utility>

#include "ice/ice.hpp"
#include "ice/labels.hpp"
#include "ice/refine/criteria.hpp"

namespace sluice::ice {
namespace {

class Quantities {
 public:
  Quantities(TaskList& list, const SchemeOptions& options)
      : list_(list), o_(options), rho_(list.old_state(labels().mass, 0, 1)) {
    energy_ = list.old_state(labels().energy, 0, 1);
    add(labels().rho, 1, rho_);
    add(labels().rho_micro, 1, rho_);
    add(labels().sum_rho, 1, rho_);
    declare_velocity();
    pressure_ = declare_of_energy(labels().pressure, [fluid = o_.fluid](double rho, double energy) {
      return fluid.pressure(rho, energy);
    });
    temperature_ = declare_of_energy(
        labels().temperature,
        [fluid = o_.fluid](double rho, double e) { return fluid.temperature(rho, e); });
    declare_pointwise();
    declare_mach();
    declare_slopes(rho_, labels().gradient_rho);
    declare_slopes(temperature_, labels().gradient_temperature);
    declare_slopes(pressure_, labels().gradient_pressure);
    declare_slopes(velocity_, labels().divergence_velocity);
    declare_vorticity();
  }
  std::vector<DiagnosticQuantity> all() && { return std::move(all_); }

 private:
  void add(Label label, int components, VariableId variable) {
    all_.push_back({label, 0, components, variable});
  }
  VariableId fresh(Label label) {
    const int components = component_count(label.info().type);
    const VariableId v = list_.temporary(label.name(), components);
    add(label, components, v);
    return v;
  }
  TaskBuilder task(Label label) {
    return list_.task("compute " + label.name(), effect_diagnostics);
  }

  void declare_velocity() {
    velocity_ = fresh(labels().velocity);
    TaskBuilder t = task(labels().velocity);
    const In rho = t.read(rho_);
    const In momentum = t.read(list_.old_state(labels().momentum, 0, o_.components));
    const Out velocity = t.write(velocity_);
    t.kernel([=, components = o_.components, direction = o_.direction](const Row& row) {
      const int n = row.count();
      const double* __restrict r = row(rho);
      for (int d = 0; d < 3; ++d) {
        double* __restrict u = row(velocity, d);
        for (int i = 0; i < n; ++i) u[i] = 0.0;
      }
      for (int c = 0; c < components; ++c) {
        const double* __restrict m = row(momentum, c);
        double* __restrict u = row(velocity, direction[static_cast<std::size_t>(c)]);
        for (int i = 0; i < n; ++i) u[i] = m[i] / r[i];
      }
    });
  }

  // f of two cell variables.
  template <class F>
  VariableId declare_of(VariableId first, VariableId second, Label label, F f) {
    const VariableId v = fresh(label);
    TaskBuilder t = task(label);
    const In a = t.read(first), b = t.read(second);
    const Out out = t.write(v);
    t.kernel([=](const Row& row) {
      const double* __restrict x = row(a);
      const double* __restrict y = row(b);
      double* __restrict to = row(out);
      const int n = row.count();
      for (int i = 0; i < n; ++i) to[i] = f(x[i], y[i]);
    });
    return v;
  }
  template <class F>
  VariableId declare_of_energy(Label label, F f) {
    return declare_of(rho_, energy_, label, f);
  }
  template <class F>
  void declare_of_pressure(Label label, F f) {
    declare_of(rho_, pressure_, label, f);
  }
  // The same in every cell as long as there is one material with constant properties.
  void declare_constant(Label label, double value) {
    declare_of(rho_, rho_, label, [value](double, double) { return value; });
  }

  void declare_pointwise() {
    const Labels& l = labels();
    const Fluid fluid = o_.fluid;
    declare_of_pressure(l.specific_volume, [](double rho, double) { return 1.0 / rho; });
    declare_of_pressure(l.sound_speed,
                        [fluid](double rho, double p) { return fluid.sound_speed(rho, p); });
    declare_of_pressure(l.compressibility, [fluid](double rho, double p) {
      const double c = fluid.sound_speed(rho, p);
      return 1.0 / (rho * c * c);
    });
    declare_constant(l.volume_fraction, 1.0);
    declare_constant(l.gradient_volume_fraction, 0.0);
    declare_constant(l.viscosity, o_.viscosity);
    declare_constant(l.thermal_conductivity, 0.0);
    declare_constant(l.gamma, fluid.gamma);
    declare_constant(l.specific_heat, fluid.specific_heat);
  }

  void declare_mach() {
    const VariableId v = fresh(labels().mach);
    TaskBuilder t = task(labels().mach);
    const In rho = t.read(rho_), pressure = t.read(pressure_), u = t.read(velocity_);
    const Out out = t.write(v);
    t.kernel([=, fluid = o_.fluid](const Row& row) {
      const double* r = row(rho);
      const double* q = row(pressure);
      const double* w[3] = {row(u, 0), row(u, 1), row(u, 2)};
      double* to = row(out);
      for (int i = 0; i < row.count(); ++i)
        to[i] = std::sqrt(w[0][i] * w[0][i] + w[1][i] * w[1][i] + w[2][i] * w[2][i]) /
                fluid.sound_speed(r[i], q[i]);
    });
  }

  // Root of the sum over the axes of the squared slope along each: of a number, the magnitude of its
  // gradient; of a vector, each component along its own axis.
  void declare_slopes(VariableId of, Label label) {
    const VariableId v = fresh(label);
    TaskBuilder t = task(label);
    const In in = t.read(of, Stencil::box(1));
    const Out out = t.write(v);
    t.kernel([=, vector = of == velocity_, axes = o_.axes](const Row& row) {
      double* to = row(out);
      const double* low[3];
      const double* high[3];
      for (int a = 0; a < axes.count; ++a) {
        const int component = vector ? axes.direction[a] : 0;
        low[a] = row(in, component, a, -1);
        high[a] = row(in, component, a, 1);
      }
      for (int i = 0; i < row.count(); ++i) {
        double sum = 0;
        for (int a = 0; a < axes.count; ++a) {
          const double slope =
              (high[a][i] - low[a][i]) / (2.0 * row.step().spacing[axes.direction[a]]);
          sum += slope * slope;
        }
        to[i] = std::sqrt(sum);
      }
    });
  }

  void declare_vorticity() {
    const VariableId v = fresh(labels().vorticity);
    TaskBuilder t = task(labels().vorticity);
    const In u = t.read(velocity_, Stencil::box(1));
    const Out out = t.write(v);
    int axis_of[3] = {-1, -1, -1};
    for (int a = 0; a < o_.axes.count; ++a) axis_of[o_.axes.direction[a]] = a;
    const int x = axis_of[0], y = axis_of[1], z = axis_of[2];
    t.kernel([=](const Row& row) {
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

  TaskList& list_;
  const SchemeOptions& o_;
  VariableId rho_, energy_, velocity_, pressure_, temperature_;
  std::vector<DiagnosticQuantity> all_;
};

void save(TaskList& list, const DiagnosticQuantity& q) {
  TaskBuilder task = list.task("save " + q.label.name(), effect_diagnostics);
  const In in = task.read(q.variable);
  const Out out = task.write(list.output(q.label, q.material));
  task.kernel([=, components = q.components](const Row& row) {
    for (int c = 0; c < components; ++c) {
      const double* __restrict from = row(in, c);
      double* __restrict to = row(out, c);
      const int n = row.count();
      for (int i = 0; i < n; ++i) to[i] = from[i];
    }
  });
}

}  // namespace

std::vector<DiagnosticQuantity> declare_quantities(TaskList& list, const SchemeOptions& options) {
  return Quantities(list, options).all();
}

const DiagnosticQuantity& quantity(const std::vector<DiagnosticQuantity>& quantities,
                                   const std::string& label, int material) {
  for (const DiagnosticQuantity& q : quantities)
    if (q.label.name() == label && q.material == material) return q;
  throw std::logic_error("criterion of refinement on " + label + " of material " +
                         std::to_string(material) + ": no such variable");
}

void declare_diagnostic_outputs(TaskList& list, const SchemeOptions& o, const IceScene& ice,
                                const std::vector<ErrorEstimate>& estimates) {
  const std::vector<DiagnosticQuantity> quantities = declare_quantities(list, o);
  for (const DiagnosticQuantity& q : quantities) save(list, q);
  add_refine_flag(list, quantities, o, ice.criteria);
  add_error_estimates(list, quantities, o, estimates);
}

}  // namespace sluice::ice
