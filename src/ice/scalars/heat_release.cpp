// The task that ends a step with heat of mixing.
#include "ice/scalars/heat_release.hpp"

#include "ice/fluid/mixed_gas.hpp"
#include "ice/one_material/update_rows.hpp"
#include "ice/sources/source_tasks.hpp"

namespace sluice::ice::scalars {
namespace {

struct Handles {
  UpdateHandles end;  // end.next: the new state
  SourceHandles sources;
  In rho, momentum, energy;  // after the remap
  In fraction, released;
  Out released_new;
};

void copy_state(const Row& row, const Handles& h, int components) {
  const auto copy = [n = row.count()](const double* from, double* to) {
    for (int i = 0; i < n; ++i) to[i] = from[i];
  };
  copy(row(h.rho), row(h.end.next.rho));
  copy(row(h.energy), row(h.end.next.energy));
  for (int c = 0; c < components; ++c) copy(row(h.momentum, c), row(h.end.next.momentum, c));
}

void release_row(const Row& row, const Handles& h, const SchemeOptions& o) {
  const SourceChange layout = source_change(o);
  const double* __restrict q = row(h.released);
  const double* __restrict rho = row(h.end.next.rho);
  double* __restrict now = row(h.released_new);
  double* __restrict E = row(h.end.next.energy);
  double* __restrict of_gas = row(h.sources.change, layout.of(0, SourceChange::energy));
  double* __restrict of_all = row(h.sources.change, layout.of(SourceChange::total_energy));
  o.mixed->for_row(row.count(), row(h.fraction), [=](int i, const models::MixedGas::Between& at) {
    const double Q = at(&models::MixedGas::Node::heat), heat = rho[i] * (Q - q[i]);
    now[i] = Q;
    E[i] += heat;
    of_gas[i] += heat;
    of_all[i] += heat;
  });
}

}  // namespace

void add_heat_release(TaskList& list, const SchemeVariables& v, const SchemeOptions& o,
                      int effect) {
  if (!o.releases_heat) return;
  TaskBuilder task = list.task("heat of mixing", effect);
  Handles h;
  h.end = read_end_of_step(task, v, o);
  h.end.next.rho = task.write(v.rho_new);
  h.end.next.momentum = task.write(v.momentum_new);
  h.end.next.energy = task.write(v.energy_new);
  h.sources = declare_sources(task, v, o);
  h.rho = task.read(v.rho_remap);
  h.momentum = task.read(v.momentum_remap);
  h.energy = task.read(v.energy_remap);
  h.fraction = task.read(v.scalars.fraction);
  h.released = task.read(v.scalars.released);
  h.released_new = task.write(v.scalars.released_new);
  dispatch(o.axes.count, o.components, [&]<int D, int C>() {
    task.kernel([=](const Row& row) {
      copy_state(row, h, C);
      add_sources_of_one(row, h.sources, o, h.end.next.rho, h.end.next.momentum, h.end.next.energy);
      release_row(row, h, o);
      check_row(row, h.end, o, o.material);
      rates_of_row<D>(row, h.end.next, o);
    });
  });
}

}  // namespace sluice::ice::scalars
