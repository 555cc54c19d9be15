// Step 7 (2-D and 3-D) with velocities of their own: what each material's velocity offers to the
// remap along axis d.
//
//   base of the mixture + w_L - sum_{t != d} h_t [u_mt L3_t(u_m) - u_t L3_t(u)] - R_t/2
// R_t, what pressure along t != d gave to w_t, goes back by half as that of the mixture does.
#include "ice/multi_velocity/tasks.hpp"
#include "ice/one_material/remap_base_rows.hpp"
#include "ice/step/material_runs.hpp"

namespace sluice::ice::mixture {
namespace {

struct Handles {
  In pure, own, velocity, velocity_L, kick, mask;
  std::array<In, 3> mixture;
  std::array<Out, 3> base;
};

template <int D, int C>
void bases(const Row& row, const Handles& h, const SchemeOptions& o, int m) {
  const int n = row.count();
  double hc[D];
  for (int t = 0; t < D; ++t)
    hc[t] = 0.5 * row.step().dt / row.step().spacing[o.grid.axes.direction[t]];
  const double* mask = o.scheme.masked ? row(h.mask) : nullptr;
  for (int c = 0; c < C; ++c) {
    const Quantity own = quantity<D>(row, h.own, m * C + c), all = quantity<D>(row, h.velocity, c);
    const double* w = row(h.velocity_L, m * C + c);
    for (int d = 0; d < D; ++d) {
      const double* mixture = row(h.mixture[d], 2 + c);
      double* to = row(h.base[d], m * C + c);
      for (int i = 0; i < n; ++i) {
        double change = 0;
        for (int t = 0; t < D; ++t) {
          if (t == d) continue;
          const auto carried = [&](const Quantity& q, const double* u) {
            return u[i] * central_slope(q.centre[i] - q.minus[t][i], q.plus[t][i] - q.centre[i]);
          };
          change +=
              hc[t] * (carried(own, row(h.own, m * C + t)) - carried(all, row(h.velocity, t)));
          if (t == c) change += 0.5 * row(h.kick, m * D + t)[i];
        }
        to[i] = mixture[i] + (w[i] - (mask != nullptr ? mask[i] : 1.0) * change);
      }
    }
  }
}

}  // namespace

void add_slip_bases(TaskList& list, const SlipBasesInput& v, const SchemeOptions& o, int effect) {
  if (!o.scheme.second_order || o.grid.axes.count == 1) return;  // the base is the Lagrangian value
  TaskBuilder task = list.task("remap bases of each velocity", effect);
  Handles h;
  h.pure = task.read(v.pure);
  h.own = task.read(v.own_velocity, Stencil::box(1));
  h.velocity = task.read(v.velocity, Stencil::box(1));
  h.velocity_L = task.read(v.velocity_L);
  h.kick = task.read(v.kick);
  if (o.scheme.masked) h.mask = task.read(v.mask);
  for (int d = 0; d < o.grid.axes.count; ++d) {
    h.mixture[d] = task.read(v.mixture_base[d]);
    h.base[d] = task.write(v.base[d]);
  }
  const int materials = static_cast<int>(o.materials.fluids.size());
  dispatch(o.grid.axes.count, o.grid.components, [&]<int D, int C>() {
    if constexpr (D > 1)
      task.kernel([=](const Row& row) {
        for_each_run(runs_of(row, h.pure), row.count(), [&](int first, int count, double pure) {
          if (pure >= 0.0) return;
          const Row part = row.part(first, count);
          for (int m = 0; m < materials; ++m) bases<D, C>(part, h, o, m);
        });
      });
  });
}

}  // namespace sluice::ice::mixture
