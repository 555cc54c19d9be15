// Step 1: velocity, pressure and sound speed of the old state, ghosts included.
#include <cmath>

#include "ice/fluid/closure_rows.hpp"
#include "ice/one_material/primitives_rows.hpp"
#include "ice/step/mixed_fraction.hpp"

namespace sluice::ice {

void primitive_row(const Fluid& fluid, int n, const double* __restrict r,
                   const double* __restrict E, double* __restrict w, double* __restrict p,
                   double* __restrict c) {
  if (const eos::IdealGas* gas = fluid.ideal()) {
#pragma GCC ivdep
    for (int i = 0; i < n; ++i) {
      w[i] = 1.0 / r[i];
      p[i] = gas->pressure(r[i], E[i]);
      c[i] = std::sqrt(gas->gamma * p[i] * w[i]);
    }
    return;
  }
  pressure_and_modulus_row(fluid, n, r, E, p, c);
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    w[i] = 1.0 / r[i];
    c[i] = std::sqrt(c[i] * w[i]);
  }
}

void velocity_rows(const Row& row, In momentum, Out velocity, const double* __restrict w,
                   int components) {
  const int n = row.whole_vectors();
  for (int q = 0; q < components; ++q) {
    const double* __restrict m = row(momentum, q);
    double* __restrict u = row(velocity, q);
#pragma GCC ivdep
    for (int i = 0; i < n; ++i) u[i] = m[i] * w[i];
  }
}

void add_primitives(TaskList& list, const SchemeVariables& v, const SchemeOptions& o, int effect) {
  TaskBuilder task = list.task("primitives", effect);
  const In rho = task.read(v.rho), momentum = task.read(v.momentum), energy = task.read(v.energy);
  const Out velocity = task.write(v.velocity), pressure = task.write(v.pressure);
  const Out sound = task.write(v.sound), inverse = task.write(v.inverse_rho);
  const Fluid fluid = o.fluid;
  const int components = o.components;
  if (o.mixed != nullptr) {
    const In f = task.read(old_fraction(list, o));
    task.kernel([=, gas = o.mixed](const Row& row) {
      mixed_primitive_row(*gas, row.count(), row(f), row(rho), row(energy), row(inverse),
                          row(pressure), row(sound));
      velocity_rows(row, momentum, velocity, row(inverse), components);
    });
    return;
  }
  task.kernel([=](const Row& row) {
    // Other laws may search for a root, which what lies beyond the row need not have.
    const int n = fluid.ideal() != nullptr ? row.whole_vectors() : row.count();
    primitive_row(fluid, n, row(rho), row(energy), row(inverse), row(pressure), row(sound));
    velocity_rows(row, momentum, velocity, row(inverse), components);
  });
}

}  // namespace sluice::ice
