// What gravity and a driving force f add in a step, summed exactly over the uncovered cells.
//
//   impulse dt (g rho + f) V,   work dt (g + f/rho) . (m - dp/2) V
// with the momentum m at the start of the step and what the Lagrangian phase took from it, dp: the
// mean momentum of the phase. Absent with one level and without f, where totals at the start of the
// step do.
#include <algorithm>

#include "framework/refine/coverage.hpp"
#include "framework/task/reductions.hpp"
#include "ice/conservative/variables.hpp"

namespace sluice::ice {
namespace {

struct Handles {
  In rho, momentum, impulse;
};

// Cells first .. first + count - 1 of the row.
void account_cells(const Row& row, const Handles& h, const SchemeOptions& o, int first, int count) {
  constexpr int chunk = 256;
  const Vec3 dx = row.step().spacing;
  const double volume = dx.x * dx.y * dx.z;
  double values[chunk];
  for (int begin = first; begin < first + count; begin += chunk) {
    const int n = first + count - begin < chunk ? first + count - begin : chunk;
    const auto size = static_cast<std::size_t>(n);
    for (int c = 0; c < o.components; ++c) {
      const int direction = o.direction[static_cast<std::size_t>(c)];
      const double kick = row.step().dt * o.gravity[direction] * volume;
      const double push = row.step().dt * o.force[direction] * volume;
      if (kick == 0.0 && push == 0.0) continue;
      const double* rho = row(h.rho) + begin;
      for (int i = 0; i < n; ++i) values[i] = kick * rho[i] + push;
      row.reductions().sum(StepSlots::gravity_impulse + direction).add(values, size);
      const double* m = row(h.momentum, c) + begin;
      const double* dp = row(h.impulse, c) + begin;
      for (int i = 0; i < n; ++i) values[i] = (kick + push / rho[i]) * (m[i] - 0.5 * dp[i]);
      row.reductions().sum(StepSlots::gravity_work).add(values, size);
    }
  }
}

void account_row(const Row& row, const Handles& h, const SchemeOptions& o) {
  if (o.coverage == nullptr || !o.coverage->any()) {
    account_cells(row, h, o, 0, row.count());
    return;
  }
  const int low = row.cell()[o.axes.direction[0]], high = low + row.count();
  for (const LevelCoverage::Segment& s : o.coverage->uncovered_in_row(row.box(), row.cell())) {
    const int first = std::max(s.first, low), end = std::min(s.first + s.count, high);
    if (first < end) account_cells(row, h, o, first - low, end - first);
  }
}

}  // namespace

void add_gravity_account(TaskList& list, const SchemeVariables& v, const SchemeOptions& o,
                         int effect) {
  if (!o.gravity_on || (o.coverage == nullptr && !o.force_on)) return;
  TaskBuilder task = list.task("gravity account", effect);
  Handles h;
  h.rho = task.read(v.rho);
  h.momentum = task.read(v.momentum);
  h.impulse = task.read(v.impulse);
  task.always().kernel([=](const Row& row) { account_row(row, h, o); });
}

}  // namespace sluice::ice
