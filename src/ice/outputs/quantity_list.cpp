// Velocity, slopes and curls of cell variables.
#include "ice/outputs/quantity_list.hpp"

namespace sluice::ice {

VariableId QuantityList::velocity(VariableId rho_id, VariableId momentum_id) {
  const VariableId v = fresh(labels().velocity, 0);
  TaskBuilder t = task(labels().velocity, 0);
  const In rho = t.read(rho_id), momentum = t.read(momentum_id);
  const Out velocity = t.write(v);
  t.kernel([=, components = o_.grid.components, direction = o_.grid.direction](const Row& row) {
    const int n = row.count();
    const double* __restrict r = row(rho);
    for (int d = 0; d < 3; ++d) {
      double* __restrict u = row(velocity, d);
      for (int i = 0; i < n; ++i) u[i] = 0.0;
    }
    for (int c = 0; c < components; ++c) {
      const double* __restrict m = row(momentum, c);
      double* __restrict u = row(velocity, direction[c]);
      for (int i = 0; i < n; ++i) u[i] = m[i] / r[i];
    }
  });
  return v;
}

void QuantityList::mach(VariableId velocity, VariableId sound, int material) {
  const VariableId v = fresh(labels().mach, material);
  TaskBuilder t = task(labels().mach, material);
  const In u = t.read(velocity), c = t.read(sound);
  const Out out = t.write(v);
  t.kernel([=](const Row& row) {
    const double* speed = row(c);
    const double* w[3] = {row(u, 0), row(u, 1), row(u, 2)};
    double* to = row(out);
    for (int i = 0; i < row.count(); ++i)
      to[i] = std::sqrt(w[0][i] * w[0][i] + w[1][i] * w[1][i] + w[2][i] * w[2][i]) / speed[i];
  });
}

void QuantityList::slopes(VariableId of, Label label, int material, bool vector) {
  const VariableId v = fresh(label, material);
  TaskBuilder t = task(label, material);
  const In in = t.read(of, Stencil::box(1));
  const Out out = t.write(v);
  t.kernel([=, axes = o_.grid.axes](const Row& row) {
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

void QuantityList::vorticity(VariableId velocity, int material) {
  const VariableId v = fresh(labels().vorticity, material);
  TaskBuilder t = task(labels().vorticity, material);
  const In u = t.read(velocity, Stencil::box(1));
  const Out out = t.write(v);
  int axis_of[3] = {-1, -1, -1};
  for (int a = 0; a < o_.grid.axes.count; ++a) axis_of[o_.grid.axes.direction[a]] = a;
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

}  // namespace sluice::ice
