// Step 9: declaring the update; update_rows.hpp.
#include "ice/one_material/tasks.hpp"
#include "ice/one_material/update_rows.hpp"
#include "ice/sources/source_tasks.hpp"

namespace sluice::ice {

void add_update(TaskList& list, const UpdateInput& v, const SchemeOptions& o, int effect) {
  TaskBuilder task = list.task("update", effect);
  const UpdateHandles h = declare_update(task, v, o);
  if (o.materials.releases_heat) {  // the step ends in scalars/heat_release.cpp
    dispatch(o.grid.axes.count, o.grid.components, [&]<int D, int C>() {
      task.kernel([=](const Row& row) { update_row<D, C>(row, h); });
    });
    return;
  }
  const SourceHandles sources = declare_sources(task, v.source_change, o);
  dispatch(o.grid.axes.count, o.grid.components, [&]<int D, int C>() {
    task.kernel([=](const Row& row) {
      update_row<D, C>(row, h);
      add_sources_of_one(row, sources, o, h.next.rho, h.next.momentum, h.next.energy);
      check_row(row, h, o, o.materials.index);
      rates_of_row<D>(row, h.next, o);
    });
  });
}

}  // namespace sluice::ice
