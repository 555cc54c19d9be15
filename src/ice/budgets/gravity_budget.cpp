// What gravity and a driving force f add in a step, summed exactly over the uncovered cells.
//
//   impulse dt (g rho + f) V,   work dt (g + f/rho) . (m - dp/2) V
// with the momentum m at the start of the step and what the Lagrangian phase took from it, dp: the
// mean momentum of the phase. Absent with one level and without f, where totals at the start of the
// step do.
#include "ice/budgets/tasks.hpp"
#include "ice/step/cell_sums.hpp"

namespace sluice::ice {
namespace {

struct Handles {
  In rho, momentum, impulse;
};

// Cells first to end - 1 of the row.
void account_cells(const Row& row, const Handles& h, const SchemeOptions& o, int first, int end) {
  const double volume = cell_volume(row);
  const double* rho = row(h.rho);
  for (int c = 0; c < o.grid.components; ++c) {
    const int direction = o.grid.direction[c];
    const double kick = row.step().dt * o.forces.gravity[direction] * volume;
    const double push = row.step().dt * o.forces.driving[direction] * volume;
    if (kick == 0.0 && push == 0.0) continue;
    const double* m = row(h.momentum, c);
    const double* dp = row(h.impulse, c);
    add_to_sum(row.reductions().sum(StepSlots::gravity_impulse + direction), first, end,
               [=](int i) { return kick * rho[i] + push; });
    add_to_sum(row.reductions().sum(StepSlots::gravity_work), first, end,
               [=](int i) { return (kick + push / rho[i]) * (m[i] - 0.5 * dp[i]); });
  }
}

}  // namespace

void add_gravity_budget(TaskList& list, const ForceBudgetInput& v, const SchemeOptions& o,
                        int effect) {
  if (!o.forces.on || (o.budgets.coverage == nullptr && !o.forces.driving_on)) return;
  TaskBuilder task = list.task("gravity account", effect);
  Handles h;
  h.rho = task.read(v.rho);
  h.momentum = task.read(v.momentum);
  h.impulse = task.read(v.impulse);
  task.always().kernel([=](const Row& row) {
    for_uncovered(row, o, [&](int first, int end) { account_cells(row, h, o, first, end); });
  });
}

}  // namespace sluice::ice
