// The task that ends a step with heat of mixing.
#include "ice/scalars/heat_release.hpp"

#include "ice/fluid/mixed_gas.hpp"
#include "ice/scalars/release_rows.hpp"

namespace sluice::ice::scalars {
namespace {

struct Handles {
  ReleaseHandles release;
  In fraction, released;
  Out released_new;
};

void release_row(const Row& row, const Handles& h, const SchemeOptions& o) {
  const double* __restrict q = row(h.released);
  const double* __restrict rho = row(h.release.end.next.rho);
  double* __restrict now = row(h.released_new);
  double* __restrict E = row(h.release.end.next.energy);
  const HeatBudget books(row, h.release, o);
  o.materials.mixed->for_each_in_row(
      row.count(), row(h.fraction), [=](int i, const models::MixedGas::Between& at) {
        const double Q = at(&models::MixedGas::Node::heat), heat = rho[i] * (Q - q[i]);
        now[i] = Q;
        E[i] += heat;
        books.add(i, heat);
      });
}

}  // namespace

void add_heat_release(TaskList& list, const HeatReleaseInput& v, const SchemeOptions& o,
                      int effect) {
  if (!o.materials.releases_heat || o.materials.mixed->species) return;
  TaskBuilder task = list.task("heat of mixing", effect);
  Handles h;
  h.release = declare_heat_release(task, v.release, o);
  h.fraction = task.read(v.fraction);
  h.released = task.read(v.released);
  h.released_new = task.write(v.released_new);
  dispatch(o.grid.axes.count, o.grid.components, [&]<int D, int C>() {
    task.kernel([=](const Row& row) {
      begin_heat_release(row, h.release, o);
      release_row(row, h, o);
      end_heat_release<D>(row, h.release, o);
    });
  });
}

}  // namespace sluice::ice::scalars
