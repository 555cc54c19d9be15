// Step i2: slopes of the normal velocity and of the pressure; transverse advection of the velocity.
//
//   su_d = L5(u_d along d),  sp_d = L5(q along d),  q = (ps_b - ps_a) - (rho_a + rho_b)/2 g_d dx_d
//   UT_d = sum_{t != d} h_t u_t L3_t(u_d)
// L5 of cell k from the differences d0..d3 over the faces k - 3/2 .. k + 3/2, c_i = d_i - d_(i-1):
// where all three c_i have one sign
//   L3(d1,d2) + t ((d1 + d2)/2 - L3(d1,d2)),  t = clip((min|c|/max|c| - .3)/.3, 0, 1),
// else L3(d1,d2): extrema that are resolved are not clipped, for at a smooth extremum the curvature
// changes little (sound then has third order). Of first order all slopes are zero.
#include <algorithm>

#include "ice/fluid/limiters.hpp"
#include "ice/one_material/quantity_rows.hpp"
#include "ice/pressure/variables.hpp"
#include "ice/step/slope_rows.hpp"

namespace sluice::ice::pressure {
namespace {

struct Handles {
  In rho, velocity, pressure, mask, open;
  Out velocity_slope, pressure_slope, transverse;
};

SlopeOutputs slopes_of(const Handles& h) {
  return {h.velocity_slope, h.pressure_slope, h.transverse};
}

[[gnu::always_inline]] inline double slope_of_five(double d0, double d1, double d2, double d3) {
  const double limited = central_slope(d1, d2);
  const double c1 = d1 - d0, c2 = d2 - d1, c3 = d3 - d2;
  const double low = smaller(smaller(c1, c2), c3), high = larger(larger(c1, c2), c3);
  // min|c|/max|c| where all have one sign: low/high above zero, high/low below.
  const double top = low > 0.0 ? low : -high, bottom = low > 0.0 ? high : -low;
  const double ratio = top > 0.0 ? top / bottom : 0.0;
  const double t = smaller(larger((ratio - 0.3) * (1.0 / 0.3), 0.0), 1.0);
  return limited + t * (0.5 * (d1 + d2) - limited);
}

// A quantity two cells to either side along one axis.
struct Five {
  const double* at[5];
  Five(const Row& row, In in, int component, int axis) {
    for (int k = -2; k <= 2; ++k) at[k + 2] = row(in, component, axis, k);
  }
  double step(int face, int i) const { return at[face + 1][i] - at[face][i]; }
};

void velocity_slopes(const Row& row, const Handles& h, int d) {
  const int n = row.whole_vectors();
  const Five u(row, h.velocity, d, d);
  double* __restrict su = row(h.velocity_slope, d);
#pragma GCC ivdep
  for (int i = 0; i < n; ++i)
    su[i] = slope_of_five(u.step(0, i), u.step(1, i), u.step(2, i), u.step(3, i));
}

template <bool Weight>
void pressure_slopes(const Row& row, const Handles& h, int d, double g_dx, double f_dx) {
  const int n = row.whole_vectors();
  const Five p(row, h.pressure, 0, d);
  const Five r = Weight ? Five(row, h.rho, 0, d) : p;
  double* __restrict sp = row(h.pressure_slope, d);
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    double q[4];
    for (int face = 0; face < 4; ++face) {
      q[face] = p.step(face, i);
      if constexpr (Weight) q[face] -= 0.5 * g_dx * (r.at[face][i] + r.at[face + 1][i]) + f_dx;
    }
    sp[i] = slope_of_five(q[0], q[1], q[2], q[3]);
  }
}

template <int D>
void transverse_rows(const Row& row, const Handles& h, const Axes& axes) {
  const int n = row.whole_vectors();
  double half_courant[D];
  Quantity u[D];
  double* UT[D];
  for (int d = 0; d < D; ++d) {
    half_courant[d] = 0.5 * row.step().dt / row.step().spacing[axes.direction[d]];
    u[d] = quantity<D>(row, h.velocity, d);
    UT[d] = row(h.transverse, d);
  }
#pragma GCC ivdep
  for (int i = 0; i < n; ++i)
#pragma GCC unroll 3
    for (int d = 0; d < D; ++d) {
      double carried[D];
      for (int t = 0; t < D; ++t)
        carried[t] =
            half_courant[t] * u[t].centre[i] * central_slope(u[d].before(t, i), u[d].after(t, i));
      UT[d][i] = others<D>(carried, d);
    }
}

void no_slopes(const Row& row, const Handles& h, int D) {
  for (int d = 0; d < D; ++d) {
    std::fill_n(row(h.velocity_slope, d), row.whole_vectors(), 0.0);
    std::fill_n(row(h.pressure_slope, d), row.whole_vectors(), 0.0);
    if (D > 1) std::fill_n(row(h.transverse, d), row.whole_vectors(), 0.0);
  }
}

}  // namespace

void add_smooth_slopes(TaskList& list, const SolvedFacesInput& v, const SchemeOptions& o,
                       int effect) {
  TaskBuilder task = list.task("slopes", effect);
  const Stencil around = o.scheme.second_order ? Stencil::box(2) : Stencil::point();
  Handles h;
  h.rho = task.read(v.cells.moving.rho, o.forces.on ? around : Stencil::point());
  h.velocity = task.read(v.cells.moving.velocity, around);
  h.pressure = task.read(v.cells.solve.smooth, around);
  if (o.scheme.masked && !o.grid.has_cut_cells) h.mask = task.read(v.mask);
  if (o.grid.has_cut_cells) h.open = task.read(v.open);
  h.velocity_slope = task.write(v.velocity_slope);
  h.pressure_slope = task.write(v.cells.pressure_slope);
  if (o.grid.axes.count > 1) h.transverse = task.write(v.transverse_velocity);
  dispatch(o.grid.axes.count, o.grid.components, [&]<int D, int C>() {
    task.kernel([=](const Row& row) {
      if (!o.scheme.second_order) return no_slopes(row, h, D);
      for (int d = 0; d < D; ++d) {
        const int direction = o.grid.axes.direction[d];
        const double dx = row.step().spacing[direction];
        velocity_slopes(row, h, d);
        if (o.forces.on)
          pressure_slopes<true>(row, h, d, o.forces.gravity[direction] * dx,
                                o.forces.driving[direction] * dx);
        else
          pressure_slopes<false>(row, h, d, 0, 0);
      }
      if constexpr (D > 1) transverse_rows<D>(row, h, o.grid.axes);
      if (o.scheme.masked && !o.grid.has_cut_cells) mask_slopes(row, h.mask, slopes_of(h), D);
      if (o.grid.has_cut_cells) mask_slopes_at_closed_faces(row, h.open, slopes_of(h), D);
    });
  });
}

}  // namespace sluice::ice::pressure
