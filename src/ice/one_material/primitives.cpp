// Step 1: velocity, pressure and sound speed of the old state, ghosts included.
#include "ice/one_material/primitives_rows.hpp"
#include "ice/one_material/tasks.hpp"
#include "ice/step/laws_of_cells.hpp"

namespace sluice::ice {

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

void add_primitives(TaskList& list, const PrimitivesInput& v, const SchemeOptions& o, int effect) {
  TaskBuilder task = list.task("primitives", effect);
  const In rho = task.read(v.rho), momentum = task.read(v.momentum), energy = task.read(v.energy);
  const Out velocity = task.write(v.velocity), pressure = task.write(v.pressure);
  const Out sound = task.write(v.sound), inverse = task.write(v.inverse_rho);
  const LawsOfCells laws(task, list, o);
  const int components = o.grid.components;
  task.kernel([=](const Row& row) {
    const LawRow law = laws.of_one(row);
    const int n = law.takes_any_number() ? row.whole_vectors() : row.count();
    law.primitives(n, row(rho), row(energy), row(inverse), row(pressure), row(sound));
    velocity_rows(row, momentum, velocity, row(inverse), components);
  });
}

}  // namespace sluice::ice
