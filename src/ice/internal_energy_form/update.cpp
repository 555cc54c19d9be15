// Step 8 of the classic form: the new state, its admissibility and the rates of the next step.
//
//   rho' = rho + sum_d (F- - F+),  m' = (m - dp) + sum_d (F_m- - F_m+)
//   E'   = E* + sum_d (F_E- - F_E+)
// A cell must not lose more volume through its faces than it has: sum_d outflow < 1.
#include "ice/internal_energy_form/variables.hpp"
#include "ice/sources/source_tasks.hpp"
#include "ice/step/end_of_step.hpp"

namespace sluice::ice::internal_energy_form {
namespace {

struct Handles {
  In rho, momentum, impulse, energy_star;
  std::array<In, 3> flux, face_velocity;
  RateHandles next;  // the new state
  Out rest;
};

// now = start + sum_d (in - out) of flux component c.
template <int D>
void advect_row(const Row& row, const Handles& h, int component, double* __restrict now) {
  const int n = row.count();
  const double* in[D];
  const double* out[D];
  for (int d = 0; d < D; ++d) {
    const In flux = h.flux[d];
    in[d] = row(flux, component);
    out[d] = row(flux, component, d, 1);
  }
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    double gain = 0;
    for (int d = 0; d < D; ++d) gain += in[d][i] - out[d][i];
    now[i] += gain;
  }
}

template <int D, int C>
void update_rows(const Row& row, const Handles& h) {
  const int n = row.count();
  double* __restrict rho = row(h.next.rho);
  double* __restrict E = row(h.next.energy);
  const double* __restrict r = row(h.rho);
  const double* __restrict Es = row(h.energy_star);
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    rho[i] = r[i];
    E[i] = Es[i];
  }
  advect_row<D>(row, h, 0, rho);
  advect_row<D>(row, h, 1, E);
  for (int c = 0; c < C; ++c) {
    double* __restrict momentum = row(h.next.momentum, c);
    const double* __restrict m = row(h.momentum, c);
    const double* __restrict dp = row(h.impulse, c);
#pragma GCC ivdep
    for (int i = 0; i < n; ++i) momentum[i] = m[i] - dp[i];
    advect_row<D>(row, h, 2 + c, momentum);
  }
}

// What does not flow out, as a share of the cell.
template <int D>
void rest_row(const Row& row, const Handles& h, const SchemeOptions& o) {
  const int n = row.count();
  double* __restrict rest = row(h.rest);
  for (int i = 0; i < n; ++i) rest[i] = 1.0;
  for (int d = 0; d < D; ++d) {
    const double l = row.step().dt / row.step().spacing[o.grid.axes.direction[d]];
    const double* __restrict um = row(h.face_velocity[d]);
    const double* __restrict up = row(h.face_velocity[d], 0, d, 1);
#pragma GCC ivdep
    for (int i = 0; i < n; ++i) rest[i] -= l * (larger(0.0, -um[i]) + larger(0.0, up[i]));
  }
}

void check_row(const Row& row, const Handles& h, const Axes& axes) {
  const auto outflow = [](double rest) { return 1.0 - rest; };
  admissible_row<4>(row, axes,
                    {{{row(h.rest), fault_outflow, outflow},
                      {row(h.next.rho), fault_density},
                      {row(h.next.energy), fault_energy},
                      {row(h.energy_star), fault_energy}}});
}

Handles declare(TaskBuilder& task, const UpdateInput& v, const SchemeOptions& o) {
  Handles h;
  h.rho = task.read(v.rho);
  h.momentum = task.read(v.momentum);
  h.impulse = task.read(v.impulse);
  h.energy_star = task.read(v.energy_star);
  if (o.scheme.conservative_time_step) h.next.sound = task.read(v.sound, Stencil::box(1));
  for (int axis = 0; axis < o.grid.axes.count; ++axis) {
    const Stencil both = Stencil::along(o.grid.axes.direction[axis], 0, 1);
    h.flux[axis] = task.read(v.flux[axis], both);
    h.face_velocity[axis] = task.read(v.face_velocity[axis], both);
  }
  h.next.face_velocity = h.face_velocity;
  h.next.rho = task.write(v.rho_new);
  h.next.momentum = task.write(v.momentum_new);
  h.next.energy = task.write(v.energy_new);
  h.rest = task.write(v.rest);
  return h;
}

}  // namespace

void add_update(TaskList& list, const UpdateInput& v, const SchemeOptions& o, int effect) {
  TaskBuilder task = list.task("update", effect);
  const Handles h = declare(task, v, o);
  const SourceHandles sources = declare_sources(task, v.source_change, o);
  dispatch(o.grid.axes.count, o.grid.components, [&]<int D, int C>() {
    task.kernel([=](const Row& row) {
      update_rows<D, C>(row, h);
      rest_row<D>(row, h, o);
      add_sources_of_one(row, sources, o, h.next.rho, h.next.momentum, h.next.energy);
      check_row(row, h, o.grid.axes);
      rates_of_row<D>(row, h.next, o);
    });
  });
}

}  // namespace sluice::ice::internal_energy_form
