// What a driving force works on materials that move against the mixture, summed exactly over the
// uncovered cells: it joins the work on the mixture (budgets/gravity_budget.cpp).
#include "ice/budgets/tasks.hpp"
#include "ice/multi_velocity/tasks.hpp"
#include "ice/step/cell_sums.hpp"

namespace sluice::ice::mixture {
void add_relative_velocity_force_budget(TaskList& list, VariableId force_work,
                                        const SchemeOptions& o, int effect) {
  if (!o.forces.driving_on) return;
  TaskBuilder task = list.task("account of the force on slip", effect);
  const In work = task.read(force_work);
  task.always().kernel([=](const Row& row) {
    const double* W = row(work);
    const double volume = cell_volume(row);
    for_uncovered(row, o, [&](int first, int end) {
      add_to_sum(row.reductions().sum(StepSlots::gravity_work), first, end,
                 [=](int i) { return W[i] * volume; });
    });
  });
}

}  // namespace sluice::ice::mixture
