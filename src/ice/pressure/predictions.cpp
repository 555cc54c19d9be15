// Step i3: what the faces know before the pressure is solved for.
//
//   u_L = u_a + su_a/2 - UT_a + h_d u_a sum_{t != d} su_t dx_d/dx_t,   u_R = u_b - su_b/2 - ...
//   p_L = ps_a + sp_a/2 + rho_a g dx/2,   p_R = ps_b - sp_b/2 - rho_b g dx/2
//   z_L, z_R, phi as at the faces of an explicit step, w = min(1/4, 1/6 + .1766 C^2)
//   u* = (rho_a u_L + rho_b u_R)/(rho_a + rho_b) + (w - 1/4)(su_a - su_b)
//        + 1/2 min(1,1/C)(p_L - p_R)/(z_L + z_R) + dt/2 (g + f + (Fv_a + Fv_b)/(rho_a + rho_b))
//   j  = min( phi z_L z_R/(z_L + z_R), .25 min(rho_a,rho_b) dx/dt ) (u_L - u_R)
//   k  = w min(1,1/C)(sp_a - sp_b) + h/2 (u_a sp_a + u_b sp_b)
// C = c dt/dx, the larger of the two cells. w cancels the phase error of space against that of time
// for C <= .7. The sum over su_t takes the compression across out of the transverse advection: the
// prediction is Eulerian up to what the solve will find.
#include "ice/fluid/limiters.hpp"
#include "ice/pressure/variables.hpp"
#include "ice/step/remap_bounds.hpp"

namespace sluice::ice::pressure {
namespace {

struct Handles {
  In rho, sound, velocity, pressure, velocity_slope, pressure_slope, transverse, force;
  In shock_slope, pi;  // of a mixture
  In open;             // beside solids: 1 where slopes count
  Out prediction;
};

// One row in the low and in the high cell of each face.
struct Both {
  const double *a, *b;
  Both(const Row& row, In in, int component, int axis)
      : a(row(in, component, axis, -1)), b(row(in, component)) {}
  Both() = default;
};

struct Constants {
  double h, dx_per_dt, l;  // dt/(2 dx), dx/dt, dt/dx
  double g_dx, f_dx;       // weight over a cell: rho g_dx + f_dx
  double half_dt;
  double ratio[3];  // dx_d/dx_t by axis
};

Constants constants(const Row& row, const SchemeOptions& o, int axis) {
  const int d = o.grid.axes.direction[axis];
  const double dx = row.step().spacing[d], dt = row.step().dt;
  Constants k{};
  k.h = 0.5 * dt / dx;
  k.dx_per_dt = dx / dt;
  k.l = dt / dx;
  k.g_dx = o.forces.gravity[d] * dx;
  k.f_dx = o.forces.driving[d] * dx;
  k.half_dt = 0.5 * dt;
  for (int t = 0; t < o.grid.axes.count; ++t)
    k.ratio[t] = dx / row.step().spacing[o.grid.axes.direction[t]];
  return k;
}

// Shock slope and minus the lowest pressure of the two cells: one law, or rows.
struct OneLaw {
  double slope, lowest;
  double slope_a(int) const { return slope; }
  double slope_b(int) const { return slope; }
  double pi_a(int) const { return lowest; }
  double pi_b(int) const { return lowest; }
};
struct LawOfCells {
  Both slope, pi;
  double slope_a(int i) const { return slope.a[i]; }
  double slope_b(int i) const { return slope.b[i]; }
  double pi_a(int i) const { return pi.a[i]; }
  double pi_b(int i) const { return pi.b[i]; }
};

// Beside solids, of a face between a cell whose slope counts and one whose slope does not: j with
// the slope of the first in both, where that is less. With none in one of them j is a drag in
// flows that follow a wall.
void ease_jumps(const Row& row, const Handles& h, int axis) {
  const int n = row.count();
  const Both open(row, h.open, axis, axis), u(row, h.velocity, axis, axis);
  const Both su(row, h.velocity_slope, axis, axis);
  double* __restrict jump = row(h.prediction, jump_pressure);
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    const bool one = open.a[i] != open.b[i];
    const double slope = su.a[i] + su.b[i];  // one of them is 0
    const double before = (u.a[i] - u.b[i]) + 0.5 * slope, after = before + 0.5 * slope;
    const double left = before * after > 0 ? smaller(1.0, after / before) : 0.0;
    jump[i] *= one ? left : 1.0;
  }
}

template <int D, bool Viscous, class Law>
void prediction_row(const Row& row, const Handles& h, int axis, const Constants& constants,
                    const Law& of) {
  const int n = row.whole_vectors();
  const Constants k = constants;
  const Law law = of;
  const Both r(row, h.rho, 0, axis), c(row, h.sound, 0, axis), p(row, h.pressure, 0, axis);
  const Both u(row, h.velocity, axis, axis), sp(row, h.pressure_slope, axis, axis);
  // Slopes along the axis and across it: no choice is left to the loop.
  const Both su(row, h.velocity_slope, axis, axis);
  Both across[D], UT, F;
  double ratio[D] = {};
  for (int t = 0, n_across = 0; t < D; ++t)
    if (t != axis) {
      across[n_across] = Both(row, h.velocity_slope, t, axis);
      ratio[n_across++] = k.ratio[t];
    }
  if constexpr (D > 1) UT = Both(row, h.transverse, axis, axis);
  if constexpr (Viscous) F = Both(row, h.force, axis, axis);
  double* __restrict star = row(h.prediction, star_velocity);
  double* __restrict jump = row(h.prediction, jump_pressure);
  double* __restrict slope = row(h.prediction, slope_pressure);
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    double uL = u.a[i] + 0.5 * su.a[i], uR = u.b[i] - 0.5 * su.b[i];
    if constexpr (D > 1) {
      double across_a = 0, across_b = 0;
      for (int t = 0; t < D - 1; ++t) {
        across_a += across[t].a[i] * ratio[t];
        across_b += across[t].b[i] * ratio[t];
      }
      uL += k.h * u.a[i] * across_a - UT.a[i];
      uR += k.h * u.b[i] * across_b - UT.b[i];
    }
    const double ra = r.a[i], rb = r.b[i];
    const double weight_a = 0.5 * (k.g_dx * ra + k.f_dx), weight_b = 0.5 * (k.g_dx * rb + k.f_dx);
    const double pia = law.pi_a(i), pib = law.pi_b(i);
    const double pL = larger(p.a[i] + 0.5 * sp.a[i], face_floor * (p.a[i] + pia) - pia) + weight_a;
    const double pR = larger(p.b[i] - 0.5 * sp.b[i], face_floor * (p.b[i] + pib) - pib) - weight_b;
    const double p_jump = (p.b[i] - p.a[i]) - (weight_a + weight_b);
    // Impedances and phi: one_material/faces.cpp.
    const double du = uL - uR, squeeze = larger(0.0, du);
    double zL = ra * (c.a[i] + 0.5 * law.slope_a(i) * squeeze);
    double zR = rb * (c.b[i] + 0.5 * law.slope_b(i) * squeeze);
    const double u0 = ((zL * uL + zR * uR) + (pL - pR)) / (zL + zR);
    zL = ra * (c.a[i] + law.slope_a(i) * larger(0.0, uL - u0));
    zR = rb * (c.b[i] + law.slope_b(i) * larger(0.0, u0 - uR));
    const double per_z = 1.0 / (zL + zR), per_r = 1.0 / (ra + rb);
    const double most = larger(std::fabs(du), std::fabs(u.b[i] - u.a[i]));
    const double wanted = 2.0 * std::fabs(p_jump) + 0.5 * (ra + rb) * (most * most);
    const double full = 0.5 * (ra * c.a[i] + rb * c.b[i]) * most;
    const double phi = wanted < full ? wanted / full : 1.0;
    const double C = k.l * larger(c.a[i], c.b[i]);
    const double w = smaller(0.25, 1.0 / 6.0 + 0.1766 * C * C), per_C = 1.0 / larger(1.0, C);
    double force = 0;
    if constexpr (Viscous) force = (F.a[i] + F.b[i]) * per_r;
    star[i] = (ra * uL + rb * uR) * per_r + (w - 0.25) * (su.a[i] - su.b[i]) +
              0.5 * per_C * (pL - pR) * per_z + k.half_dt * force +
              k.h * (k.g_dx + 2.0 * k.f_dx * per_r);
    jump[i] = smaller(phi * (zL * zR * per_z), 0.25 * smaller(ra, rb) * k.dx_per_dt) * du;
    slope[i] = w * per_C * (sp.a[i] - sp.b[i]) + 0.5 * k.h * (u.a[i] * sp.a[i] + u.b[i] * sp.b[i]);
  }
}

template <int D, bool Viscous>
void predict(const Row& row, const Handles& h, int axis, const SchemeOptions& o) {
  const Constants k = constants(row, o, axis);
  if (o.materials.mixture)
    prediction_row<D, Viscous>(
        row, h, axis, k, LawOfCells{Both(row, h.shock_slope, 0, axis), Both(row, h.pi, 0, axis)});
  else
    prediction_row<D, Viscous>(
        row, h, axis, k,
        OneLaw{o.materials.fluid.shock_slope(), -o.materials.fluid.lowest_pressure()});
  if (o.grid.has_cut_cells) ease_jumps(row, h, axis);
}

}  // namespace

// Fv_d = sum_t (t_f+ - t_f-)_d/dx_t of the old state, N/m^3.
void add_viscous_force(TaskList& list, const SolvedFacesInput& v, const SchemeOptions& o,
                       int effect) {
  if (!o.transport.viscous) return;
  TaskBuilder task = list.task("viscous force", effect);
  std::array<In, 3> stress;
  for (int t = 0; t < o.grid.axes.count; ++t) {
    stress[t] = task.read(v.stress[t], Stencil::along(o.grid.axes.direction[t], 0, 1));
  }
  const Out force = task.write(v.cells.solve.force);
  task.kernel([=, axes = o.grid.axes](const Row& row) {
    const int n = row.whole_vectors();
    for (int d = 0; d < axes.count; ++d) {
      double* __restrict F = row(force, d);
      const double* low[3] = {};
      const double* high[3] = {};
      double per_dx[3] = {0, 0, 0};
      for (int t = 0; t < axes.count; ++t) {
        low[t] = row(stress[t], d);
        high[t] = row(stress[t], d, t, 1);
        per_dx[t] = 1.0 / row.step().spacing[axes.direction[t]];
      }
      for (int i = 0; i < n; ++i) F[i] = per_dx[0] * (high[0][i] - low[0][i]);
      for (int t = 1; t < axes.count; ++t)
        for (int i = 0; i < n; ++i) F[i] += per_dx[t] * (high[t][i] - low[t][i]);
    }
  });
}

void add_predictions(TaskList& list, const SolvedFacesInput& v, const SchemeOptions& o,
                     int effect) {
  static const char* names[] = {"predictions of axis 0", "predictions of axis 1",
                                "predictions of axis 2"};
  for (int axis = 0; axis < o.grid.axes.count; ++axis) {
    const Stencil both = Stencil::along(o.grid.axes.direction[axis], 1, 0);
    TaskBuilder task = list.task(names[axis], effect);
    Handles h;
    h.rho = task.read(v.cells.moving.rho, both);
    h.sound = task.read(v.cells.moving.sound, both);
    h.velocity = task.read(v.cells.moving.velocity, both);
    h.pressure = task.read(v.cells.solve.smooth, both);
    h.velocity_slope = task.read(v.velocity_slope, both);
    h.pressure_slope = task.read(v.cells.pressure_slope, both);
    if (o.grid.axes.count > 1) h.transverse = task.read(v.transverse_velocity, both);
    if (o.grid.has_cut_cells) h.open = task.read(v.open, both);
    if (o.transport.viscous) h.force = task.read(v.cells.solve.force, both);
    if (o.materials.mixture) {
      h.shock_slope = task.read(v.shock_slope, both);
      h.pi = task.read(v.pi, both);
    }
    h.prediction = task.write(v.cells.solve.prediction[axis]);
    dispatch(o.grid.axes.count, o.grid.components, [&]<int D, int C>() {
      task.kernel([=](const Row& row) {
        o.transport.viscous ? predict<D, true>(row, h, axis, o)
                            : predict<D, false>(row, h, axis, o);
      });
    });
  }
}

}  // namespace sluice::ice::pressure
