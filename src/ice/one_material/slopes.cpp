// Step 2: slopes of normal velocity and pressure, half-step predictions.
//
//   su_d = L3(u_d along d),  sp_d = L3(p along d)
//   P    = p - sum_d h_d rho c^2 su_d - sum_d h_d u_d sp_d          (second sum: 2-D and 3-D)
//   UT_d = sum_{t != d} h_t u_t L3_t(u_d)                           (2-D and 3-D)
// with h = dt/(2 dx). Under gravity the pressure differences are taken from the discrete
// hydrostatic balance p_{i+1} - p_i = g dx (rho_i + rho_{i+1})/2, so that a column at rest has
// no slope; the flow carries the whole pressure, sp_d + g dx rho. A driving force f per volume is
// weight too: g rho is g rho + f everywhere.
#include "framework/refine/face_table.hpp"
#include "ice/fluid/limiters.hpp"
#include "ice/one_material/leaving_shocks.hpp"
#include "ice/one_material/quantity_rows.hpp"
#include "ice/one_material/tasks.hpp"
#include "ice/step/slope_rows.hpp"
#include "ice/step/variables.hpp"

namespace sluice::ice {
namespace {

struct Handles {
  In rho, velocity, pressure, sound, mask, open;
  Out velocity_slope, pressure_slope, predicted, transverse;
};

SlopeOutputs slopes_of(const Handles& h) {
  return {h.velocity_slope, h.pressure_slope, h.transverse};
}

// What a slope needs to know of each axis.
template <int D>
struct AxisConstants {
  double half_courant[D], g_dx[D], f_dx[D];

  AxisConstants(const SchemeOptions& o, const StepConstants& step) {
    for (int d = 0; d < D; ++d) {
      const double dx = step.spacing[o.grid.axes.direction[d]];
      half_courant[d] = 0.5 * step.dt / dx;
      g_dx[d] = o.forces.gravity[o.grid.axes.direction[d]] * dx;
      f_dx[d] = o.forces.driving[o.grid.axes.direction[d]] * dx;
    }
  }
};

// All slopes in one loop: every cell around is read once.
template <int D, bool Gravity>
void slope_rows(const Row& row, const Handles& h, const AxisConstants<D>& constants) {
  const int n = row.whole_vectors();
  const AxisConstants<D> k = constants;
  const Quantity p = quantity<D>(row, h.pressure, 0);
  const Quantity r = Gravity ? quantity<D>(row, h.rho, 0) : Quantity{};
  Quantity u[D];
  double *su[D], *sp[D], *UT[D];
  for (int d = 0; d < D; ++d) {
    u[d] = quantity<D>(row, h.velocity, d);
    su[d] = row(h.velocity_slope, d);
    sp[d] = row(h.pressure_slope, d);
    if constexpr (D > 1) UT[d] = row(h.transverse, d);
  }
#pragma GCC ivdep
  for (int i = 0; i < n; ++i)
#pragma GCC unroll 3
    for (int d = 0; d < D; ++d) {
      su[d][i] = central_slope(u[d].before(d, i), u[d].after(d, i));
      double before = p.before(d, i), after = p.after(d, i);
      if constexpr (Gravity) {
        before -= 0.5 * k.g_dx[d] * (r.minus[d][i] + r.centre[i]) + k.f_dx[d];
        after -= 0.5 * k.g_dx[d] * (r.centre[i] + r.plus[d][i]) + k.f_dx[d];
      }
      sp[d][i] = central_slope(before, after);
      if constexpr (D > 1) {
        double carried[D];
        for (int t = 0; t < D; ++t)
          carried[t] = k.half_courant[t] * u[t].centre[i] *
                       central_slope(u[d].before(t, i), u[d].after(t, i));
        UT[d][i] = others<D>(carried, d);
      }
    }
}

template <int D>
void predict_row(const Row& row, const Handles& h, const AxisConstants<D>& constants) {
  const int n = row.whole_vectors();
  const auto [half_courant, g_dx, f_dx] = constants;
  const double* __restrict r = row(h.rho);
  const double* __restrict p = row(h.pressure);
  const double* __restrict c = row(h.sound);
  const double* su[3];
  const double* sp[3];
  const double* u[3];
  for (int d = 0; d < D; ++d) {
    su[d] = row(h.velocity_slope, d);
    sp[d] = row(h.pressure_slope, d);
    u[d] = row(h.velocity, d);
  }
  double* __restrict P = row(h.predicted);
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    // Sums over directions first: two-term sums commute, so x and y may change places.
    double compression = half_courant[0] * su[0][i];
    if constexpr (D > 1) compression += half_courant[1] * su[1][i];
    if constexpr (D > 2) compression += half_courant[2] * su[2][i];
    double change = r[i] * (c[i] * c[i]) * compression;
    if constexpr (D > 1) {
      // The whole slope: deviation and hydrostatic part.
      double advection = half_courant[0] * u[0][i] * (sp[0][i] + (g_dx[0] * r[i] + f_dx[0])) +
                         half_courant[1] * u[1][i] * (sp[1][i] + (g_dx[1] * r[i] + f_dx[1]));
      if constexpr (D > 2)
        advection += half_courant[2] * u[2][i] * (sp[2][i] + (g_dx[2] * r[i] + f_dx[2]));
      change += advection;
    }
    P[i] = p[i] - change;
  }
}

template <int D>
void damp_rows(const Row& row, const Handles& h, const InterfaceDistance& ends) {
  for (int d = 0; d < D; ++d)
    damp_leaving_shocks(
        row, ends, d,
        {row(h.pressure, 0, d, -1), row(h.pressure, 0, d, 1), row(h.rho), row(h.sound)},
        row(h.pressure_slope, d));
}

}  // namespace

void add_slopes(TaskList& list, const SlopesInput& v, const SchemeOptions& o, int effect) {
  if (!o.scheme.second_order) return;
  TaskBuilder task = list.task("slopes", effect);
  Handles h;
  h.rho = task.read(v.moving.rho, o.forces.on ? Stencil::box(1) : Stencil::point());
  h.velocity = task.read(v.moving.velocity, Stencil::box(1));
  h.pressure = task.read(v.pressure, Stencil::box(1));
  h.sound = task.read(v.moving.sound);
  if (o.scheme.masked && !o.grid.has_cut_cells) h.mask = task.read(v.mask);
  if (o.grid.has_cut_cells) h.open = task.read(v.open);
  if (o.grid.shocks_leave) task.needs_box();
  h.velocity_slope = task.write(v.velocity_slope);
  h.pressure_slope = task.write(v.pressure_slope);
  h.predicted = task.write(v.predicted_pressure);
  if (o.grid.axes.count > 1) h.transverse = task.write(v.transverse_velocity);
  dispatch(o.grid.axes.count, o.grid.components, [&]<int D, int C>() {
    task.kernel([=](const Row& row) {
      const AxisConstants<D> k(o, row.step());
      if (o.forces.on)
        slope_rows<D, true>(row, h, k);
      else
        slope_rows<D, false>(row, h, k);
      if (o.scheme.masked && !o.grid.has_cut_cells) mask_slopes(row, h.mask, slopes_of(h), D);
      if (o.grid.has_cut_cells) mask_slopes_at_closed_faces(row, h.open, slopes_of(h), D);
      if (o.grid.shocks_leave && o.budgets.recorder->ends != nullptr)
        damp_rows<D>(row, h, *o.budgets.recorder->ends);
      predict_row<D>(row, h, k);
    });
  });
}

}  // namespace sluice::ice
