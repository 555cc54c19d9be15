// Step 1: velocity, pressure and sound speed of the old state, ghosts included.
#include "ice/conservative/variables.hpp"

namespace sluice::ice {

void add_primitives(TaskList& list, const SchemeVariables& v, const SchemeOptions& o, int effect) {
  TaskBuilder task = list.task("primitives", effect);
  const In rho = task.read(v.rho), momentum = task.read(v.momentum), energy = task.read(v.energy);
  const Out velocity = task.write(v.velocity), pressure = task.write(v.pressure);
  const Out sound = task.write(v.sound), inverse = task.write(v.inverse_rho);
  const eos::IdealGas gas = o.gas;
  const int components = o.components;
  task.kernel([=](const Row& row) {
    const int n = row.count();
    const double* __restrict r = row(rho);
    const double* __restrict E = row(energy);
    double* __restrict p = row(pressure);
    double* __restrict c = row(sound);
    double* __restrict w = row(inverse);
#pragma GCC ivdep
    for (int i = 0; i < n; ++i) {
      w[i] = 1.0 / r[i];
      p[i] = gas.pressure(r[i], E[i]);
      c[i] = std::sqrt(gas.gamma * p[i] * w[i]);
    }
    for (int q = 0; q < components; ++q) {
      const double* __restrict m = row(momentum, q);
      double* __restrict u = row(velocity, q);
#pragma GCC ivdep
      for (int i = 0; i < n; ++i) u[i] = m[i] * w[i];
    }
  });
}

}  // namespace sluice::ice
