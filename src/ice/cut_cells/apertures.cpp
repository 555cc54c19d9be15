// Where slopes count: along an axis in cells with fluid, of which both neighbours hold some and
// whose faces are open by more than half.
#include "ice/cut_cells/variables.hpp"

namespace sluice::ice::cut_cells {

void add_apertures(TaskList& list, const AperturesInput& v, const SchemeOptions& o, int effect) {
  TaskBuilder task = list.task("where slopes count", effect);
  const In fraction = task.read(v.fraction, Stencil::box(1));
  std::array<In, 3> covered;
  for (int a = 0; a < o.grid.axes.count; ++a)
    covered[a] = task.read(v.covered[a], Stencil::along(o.grid.axes.direction[a], 0, 1));
  In mask;
  if (o.scheme.masked) mask = task.read(v.mask);
  const Out open = task.write(v.open);
  task.kernel([=](const Row& row) {
    const int n = row.count();
    const double* here = row(fraction);
    for (int a = 0; a < o.grid.axes.count; ++a) {
      const double *below = row(fraction, 0, a, -1), *above = row(fraction, 0, a, 1);
      const double* low = row(covered[a]);
      const double* high = row(covered[a], 0, a, 1);
      double* __restrict to = row(open, a);
#pragma GCC ivdep
      for (int i = 0; i < n; ++i) {
        const bool wet = (here[i] < 1) & (below[i] < 1) & (above[i] < 1);
        const bool open_by_half = (low[i] < 0.5) & (high[i] < 0.5);
        to[i] = (wet & open_by_half) ? 1.0 : 0.0;
      }
      if (!o.scheme.masked) continue;
      const double* of_redo = row(mask);
#pragma GCC ivdep
      for (int i = 0; i < n; ++i) to[i] *= of_redo[i];
    }
  });
}

}  // namespace sluice::ice::cut_cells
