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
#include "ice/conservative/leaving_shocks.hpp"
#include "ice/conservative/variables.hpp"
#include "ice/limiters.hpp"

namespace sluice::ice {
namespace {

struct Handles {
  In rho, velocity, pressure, sound, mask;
  Out velocity_slope, pressure_slope, predicted, transverse;
};

// Slope of one quantity along one axis, into s.
void slope_row(int n, const double* __restrict qm, const double* __restrict q,
               const double* __restrict qp, double* __restrict s) {
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) s[i] = central_slope(q[i] - qm[i], qp[i] - q[i]);
}

template <int D>
void pressure_slope_row(const Row& row, const Handles& h, int axis, double g_dx, double f_dx,
                        bool gravity) {
  const int n = row.whole_vectors();
  const double* __restrict pm = row(h.pressure, 0, axis, -1);
  const double* __restrict p = row(h.pressure);
  const double* __restrict pp = row(h.pressure, 0, axis, 1);
  double* __restrict s = row(h.pressure_slope, axis);
  if (!gravity) return slope_row(n, pm, p, pp, s);
  const double* __restrict rm = row(h.rho, 0, axis, -1);
  const double* __restrict r = row(h.rho);
  const double* __restrict rp = row(h.rho, 0, axis, 1);
#pragma GCC ivdep
  for (int i = 0; i < n; ++i)
    s[i] = central_slope((p[i] - pm[i]) - (0.5 * g_dx * (rm[i] + r[i]) + f_dx),
                         (pp[i] - p[i]) - (0.5 * g_dx * (r[i] + rp[i]) + f_dx));
}

template <int D>
void transverse_row(const Row& row, const Handles& h, int d, const double* half_courant) {
  const int n = row.whole_vectors();
  double* __restrict UT = row(h.transverse, d);
  bool first = true;
  for (int t = 0; t < D; ++t) {
    if (t == d) continue;
    const double* __restrict um = row(h.velocity, d, t, -1);
    const double* __restrict u = row(h.velocity, d);
    const double* __restrict up = row(h.velocity, d, t, 1);
    const double* __restrict ut = row(h.velocity, t);
    const double ht = half_courant[t];
    if (first) {
#pragma GCC ivdep
      for (int i = 0; i < n; ++i) UT[i] = ht * ut[i] * central_slope(u[i] - um[i], up[i] - u[i]);
    } else {
#pragma GCC ivdep
      for (int i = 0; i < n; ++i)
        UT[i] = UT[i] + ht * ut[i] * central_slope(u[i] - um[i], up[i] - u[i]);
    }
    first = false;
  }
}

template <int D>
void predict_row(const Row& row, const Handles& h, const double* half_courant, const double* g_dx,
                 const double* f_dx) {
  const int n = row.whole_vectors();
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
void mask_rows(const Row& row, const Handles& h) {
  const int n = row.whole_vectors();
  const double* __restrict mask = row(h.mask);
  for (int d = 0; d < D; ++d)
    for (double* __restrict s : {row(h.velocity_slope, d), row(h.pressure_slope, d),
                                 D > 1 ? row(h.transverse, d) : nullptr}) {
      if (s == nullptr) continue;
#pragma GCC ivdep
      for (int i = 0; i < n; ++i) s[i] *= mask[i];
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

void add_slopes(TaskList& list, const SchemeVariables& v, const SchemeOptions& o, int effect) {
  if (!o.second_order) return;
  TaskBuilder task = list.task("slopes", effect);
  Handles h;
  h.rho = task.read(v.rho, o.gravity_on ? Stencil::box(1) : Stencil::point());
  h.velocity = task.read(v.velocity, Stencil::box(1));
  h.pressure = task.read(v.pressure, Stencil::box(1));
  h.sound = task.read(v.sound);
  if (o.masked) h.mask = task.read(v.mask);
  h.velocity_slope = task.write(v.velocity_slope);
  h.pressure_slope = task.write(v.pressure_slope);
  h.predicted = task.write(v.predicted_pressure);
  if (o.axes.count > 1) h.transverse = task.write(v.transverse_velocity);
  dispatch(o.axes.count, o.components, [&]<int D, int C>() {
    task.kernel([=](const Row& row) {
      double half_courant[3] = {0, 0, 0}, g_dx[3] = {0, 0, 0}, f_dx[3] = {0, 0, 0};
      for (int d = 0; d < D; ++d) {
        const double dx = row.step().spacing[o.axes.direction[d]];
        half_courant[d] = 0.5 * row.step().dt / dx;
        g_dx[d] = o.gravity[o.axes.direction[d]] * dx;
        f_dx[d] = o.force[o.axes.direction[d]] * dx;
      }
      for (int d = 0; d < D; ++d) {
        slope_row(row.whole_vectors(), row(h.velocity, d, d, -1), row(h.velocity, d),
                  row(h.velocity, d, d, 1), row(h.velocity_slope, d));
        pressure_slope_row<D>(row, h, d, g_dx[d], f_dx[d], o.gravity_on);
        if constexpr (D > 1) transverse_row<D>(row, h, d, half_courant);
      }
      if (o.masked) mask_rows<D>(row, h);
      if (o.recorder != nullptr && o.recorder->ends != nullptr)
        damp_rows<D>(row, h, *o.recorder->ends);
      predict_row<D>(row, h, half_courant, g_dx, f_dx);
    });
  });
}

}  // namespace sluice::ice
