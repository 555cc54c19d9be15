// What a driving force works on materials that move against the mixture, summed exactly over the
// uncovered cells: it joins the work on the mixture (conservative/gravity_account.cpp).
#include <algorithm>

#include "framework/refine/coverage.hpp"
#include "framework/task/reductions.hpp"
#include "ice/mixture/slip.hpp"

namespace sluice::ice::mixture {
namespace {

// Cells first .. first + count - 1 of the row.
void account_cells(const Row& row, In work, int first, int count) {
  constexpr int chunk = 256;
  const Vec3 dx = row.step().spacing;
  double values[chunk];
  for (int begin = first; begin < first + count; begin += chunk) {
    const int n = std::min(chunk, first + count - begin);
    const double* W = row(work) + begin;
    for (int i = 0; i < n; ++i) values[i] = W[i] * (dx.x * dx.y * dx.z);
    row.reductions().sum(StepSlots::gravity_work).add(values, static_cast<std::size_t>(n));
  }
}

}  // namespace

void add_slip_force_account(TaskList& list, const Variables& v, const SchemeOptions& o,
                            int effect) {
  if (!o.force_on) return;
  TaskBuilder task = list.task("account of the force on slip", effect);
  const In work = task.read(v.slip.force_work);
  task.always().kernel([=](const Row& row) {
    if (o.coverage == nullptr || !o.coverage->any())
      return account_cells(row, work, 0, row.count());
    const int low = row.cell()[o.axes.direction[0]], high = low + row.count();
    for (const LevelCoverage::Segment& s : o.coverage->uncovered_in_row(row.box(), row.cell())) {
      const int first = std::max(s.first, low), end = std::min(s.first + s.count, high);
      if (first < end) account_cells(row, work, first - low, end - first);
    }
  });
}

}  // namespace sluice::ice::mixture
