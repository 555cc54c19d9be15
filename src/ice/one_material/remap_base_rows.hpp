// Step 7 (2-D and 3-D): what each cell offers to the remap along axis d.
//
//   base_d(q) = q_L - sum_{t != d} [ h_t u_t L3_t(q) - put_t(q) ]
//   put_t: + h rho su_t for rho; + h (E + p) su_t for E; + h (sp_t/rho + g_t dx_t) for u_t only
// The terms put half of the transverse Lagrangian change back, so that the face value is that of
// the middle of the step; without them the order falls to one. rho and E are floored at a tenth
// of their Lagrangian value, E of a law with another zero at E_L - .9 (p + pi)/G.
#pragma once
#include "ice/fluid/limiters.hpp"
#include "ice/one_material/quantity_rows.hpp"
#include "ice/one_material/tasks.hpp"
#include "ice/step/remap_bounds.hpp"

namespace sluice::ice {

struct RemapBaseHandles {
  In rho, energy, velocity, pressure, inverse_rho, velocity_slope, pressure_slope, mask;
  In rho_L, energy_L, velocity_L, energy_scale;
  bool solved = false;  // the pressure is solved for: read these
  std::array<In, 3> face_pressure;
  Vec3 force;  // N/m^3
  std::array<Out, 3> base;
};

// What the bases of all quantities need.
template <int D, bool Masked>
struct BaseContext {
  int n = 0;
  double h[D];                          // dt/(2 dx), s/m
  const double *u[D], *mask = nullptr;  // m/s; 0 or 1

  BaseContext(const Row& row, const RemapBaseHandles& handles, const Axes& axes)
      : n(row.whole_vectors()) {
    for (int t = 0; t < D; ++t) {
      h[t] = 0.5 * row.step().dt / row.step().spacing[axes.direction[t]];
      u[t] = row(handles.velocity, t);
    }
    if (Masked) mask = row(handles.mask);
  }
  // Change of q, in its unit, across the half step by advection along axis t.
  double advected(const Quantity& q, int t, int i) const {
    return h[t] * u[t][i] * central_slope(q.before(t, i), q.after(t, i));
  }
  double masked(double change, int i) const { return Masked ? mask[i] * change : change; }
};

// The bases of density and energy. `Scaled`: not of an ideal gas.
template <int D, bool Masked, bool Scaled, bool PutBack>
void state_base_rows(const Row& row, const RemapBaseHandles& h, const Axes& axes) {
  const BaseContext<D, Masked> x(row, h, axes);
  const Quantity rho = quantity<D>(row, h.rho, 0), E = quantity<D>(row, h.energy, 0);
  const double *p = row(h.pressure), *rL = row(h.rho_L), *EL = row(h.energy_L);
  const double* scale = Scaled ? row(h.energy_scale) : EL;
  const double* su[D];
  double *base_rho[D], *base_E[D];
  for (int d = 0; d < D; ++d) {
    su[d] = row(h.velocity_slope, d);
    base_rho[d] = row(h.base[d], 0);
    base_E[d] = row(h.base[d], 1);
  }
#pragma GCC ivdep
  for (int i = 0; i < x.n; ++i) {
    double of_rho[D], of_E[D];
    for (int t = 0; t < D; ++t) {
      double put_rho = 0.0, put_E = 0.0;
      if constexpr (PutBack) {
        put_rho = x.h[t] * rho.centre[i] * su[t][i];
        put_E = x.h[t] * (E.centre[i] + p[i]) * su[t][i];
      }
      of_rho[t] = x.masked(x.advected(rho, t, i) - put_rho, i);
      of_E[t] = x.masked(x.advected(E, t, i) - put_E, i);
    }
    const double least_rho = face_floor * rL[i];
    const double least_E = Scaled ? EL[i] - face_drop * scale[i] : face_floor * EL[i];
    for (int d = 0; d < D; ++d) {
      base_rho[d][i] = larger(rL[i] - others<D>(of_rho, d), least_rho);
      base_E[d][i] = larger(EL[i] - others<D>(of_E, d), least_E);
    }
  }
}

template <int D, int C, bool Masked>
void predicted_velocity_base_rows(const Row& row, const RemapBaseHandles& h, const Axes& axes,
                                  Vec3 gravity) {
  const BaseContext<D, Masked> x(row, h, axes);
  const double* w = row(h.inverse_rho);
  const double *sp[D], *v[C];
  double g_dx[D], *base[D][C];
  Quantity u[C];
  for (int t = 0; t < D; ++t) {
    sp[t] = row(h.pressure_slope, t);
    g_dx[t] = gravity[axes.direction[t]] * row.step().spacing[axes.direction[t]];
  }
  for (int c = 0; c < C; ++c) {
    u[c] = quantity<D>(row, h.velocity, c);
    v[c] = row(h.velocity_L, c);
    for (int d = 0; d < D; ++d) base[d][c] = row(h.base[d], 2 + c);
  }
#pragma GCC ivdep
  for (int i = 0; i < x.n; ++i)
#pragma GCC unroll 3
    for (int c = 0; c < C; ++c) {
      double change[D];
      for (int t = 0; t < D; ++t) {
        const double put = t == c ? x.h[t] * (w[i] * sp[t][i] + g_dx[t]) : 0.0;
        change[t] = x.masked(x.advected(u[c], t, i) - put, i);
      }
      for (int d = 0; d < D; ++d) base[d][c][i] = v[c][i] - others<D>(change, d);
    }
}

// Where the pressure is solved for: half of what the faces' pressures did across, the solve's part
// of it included.
template <int D, int C, bool Masked>
void solved_velocity_base_rows(const Row& row, const RemapBaseHandles& h, const Axes& axes,
                               Vec3 gravity) {
  const BaseContext<D, Masked> x(row, h, axes);
  const double* w = row(h.inverse_rho);
  const double *low[D], *high[D], *v[C];
  double g_dx[D], f_dx[D], *base[D][C];
  Quantity u[C];
  for (int t = 0; t < D; ++t) {
    const In p_f = h.face_pressure[t];
    low[t] = row(p_f);
    high[t] = row(p_f, 0, t, 1);
    g_dx[t] = gravity[axes.direction[t]] * row.step().spacing[axes.direction[t]];
    f_dx[t] = h.force[axes.direction[t]] * row.step().spacing[axes.direction[t]];
  }
  for (int c = 0; c < C; ++c) {
    u[c] = quantity<D>(row, h.velocity, c);
    v[c] = row(h.velocity_L, c);
    for (int d = 0; d < D; ++d) base[d][c] = row(h.base[d], 2 + c);
  }
#pragma GCC ivdep
  for (int i = 0; i < x.n; ++i)
#pragma GCC unroll 3
    for (int c = 0; c < C; ++c) {
      double change[D];
      for (int t = 0; t < D; ++t) {
        const double put =
            t == c ? x.h[t] * (w[i] * ((high[t][i] - low[t][i]) - f_dx[t]) - g_dx[t]) : 0.0;
        change[t] = x.masked(x.advected(u[c], t, i) - put, i);
      }
      for (int d = 0; d < D; ++d) base[d][c][i] = v[c][i] - others<D>(change, d);
    }
}

template <int D, int C, bool Masked>
void velocity_base_rows(const Row& row, const RemapBaseHandles& h, const Axes& axes, Vec3 gravity) {
  h.solved ? solved_velocity_base_rows<D, C, Masked>(row, h, axes, gravity)
           : predicted_velocity_base_rows<D, C, Masked>(row, h, axes, gravity);
}

// Where the pressure is solved for rho and E get nothing put back: what converges across is what
// the solve makes of the flow, not half the slopes of the old one.
template <int D, int C, bool Masked>
void base_rows(const Row& row, const RemapBaseHandles& h, const Axes& axes, Vec3 gravity,
               bool scaled) {
  if (h.solved)
    scaled ? state_base_rows<D, Masked, true, false>(row, h, axes)
           : state_base_rows<D, Masked, false, false>(row, h, axes);
  else
    scaled ? state_base_rows<D, Masked, true, true>(row, h, axes)
           : state_base_rows<D, Masked, false, true>(row, h, axes);
  velocity_base_rows<D, C, Masked>(row, h, axes, gravity);
}

inline RemapBaseHandles declare_remap_bases(TaskBuilder& task, const RemapBasesInput& v,
                                            const SchemeOptions& o) {
  RemapBaseHandles h;
  h.rho = task.read(v.rho, Stencil::box(1));
  h.energy = task.read(v.energy, Stencil::box(1));
  h.velocity = task.read(v.velocity, Stencil::box(1));
  h.pressure = task.read(v.pressure);
  h.inverse_rho = task.read(v.inverse_rho);
  h.velocity_slope = task.read(v.velocity_slope);
  h.pressure_slope = task.read(v.pressure_slope);
  if (o.scheme.masked) h.mask = task.read(v.mask);
  h.solved = o.scheme.implicit;
  h.force = o.forces.driving;
  if (h.solved)
    for (int d = 0; d < o.grid.axes.count; ++d) {
      h.face_pressure[d] =
          task.read(v.face_pressure[d], Stencil::along(o.grid.axes.direction[d], 0, 1));
    }
  h.rho_L = task.read(v.rho_L);
  h.energy_L = task.read(v.energy_L);
  h.velocity_L = task.read(v.velocity_L);
  if (o.materials.mixture || o.materials.fluid.gamma_law() == nullptr)
    h.energy_scale = task.read(v.energy_scale);
  for (int d = 0; d < o.grid.axes.count; ++d) h.base[d] = task.write(v.base[d]);
  return h;
}

}  // namespace sluice::ice
