// Step 7 (2-D and 3-D): what each cell offers to the remap along axis d.
//
//   base_d(q) = q_L - sum_{t != d} [ h_t u_t L3_t(q) - put_t(q) ]
//   put_t: + h rho su_t for rho; + h (E + p) su_t for E; + h (sp_t/rho + g_t dx_t) for u_t only
// The terms put half of the transverse Lagrangian change back, so that the face value is that of
// the middle of the step; without them the order falls to one. rho and E are floored at a tenth
// of their Lagrangian value, E of a law with another zero at E_L - .9 (p + pi)/G.
#pragma once
#include "ice/conservative/variables.hpp"
#include "ice/limiters.hpp"

namespace sluice::ice {

struct RemapBaseHandles {
  In rho, energy, velocity, pressure, inverse_rho, velocity_slope, pressure_slope, mask;
  In rho_L, energy_L, velocity_L, energy_scale;
  std::array<Out, 3> base;
};

// Rows of one quantity along every axis.
struct Quantity {
  const double* minus[3];
  const double* centre;
  const double* plus[3];

  template <int D>
  Quantity from(int first) const {
    Quantity q;
    q.centre = centre + first;
    for (int t = 0; t < D; ++t) {
      q.minus[t] = minus[t] + first;
      q.plus[t] = plus[t] + first;
    }
    return q;
  }
};

template <int D>
Quantity quantity(const Row& row, In in, int c) {
  Quantity q;
  q.centre = row(in, c);
  for (int t = 0; t < D; ++t) {
    q.minus[t] = row(in, c, t, -1);
    q.plus[t] = row(in, c, t, 1);
  }
  return q;
}

struct Context {
  int n;
  double h[3];
  const double* u[3];  // transverse velocities
  double g_dx[3];      // of each axis
  const double* mask;  // may be null
};

// Change of q across the half step by advection along axis t at cell i.
inline double advected(const Quantity& q, const Context& x, int t, int i) {
  return x.h[t] * x.u[t][i] *
         central_slope(q.centre[i] - q.minus[t][i], q.plus[t][i] - q.centre[i]);
}

struct NoFloor {
  double operator()(double value, int /*i*/) const { return value; }
};
struct TenthOf {
  const double* L;
  double operator()(double value, int i) const { return larger(value, 0.1 * L[i]); }
};
struct BelowBy {  // at most .9 scales below L
  const double *L, *scale;
  double operator()(double value, int i) const { return larger(value, L[i] - 0.9 * scale[i]); }
};

// base_d = L - sum of the others' changes; `change(t, i)` is the whole bracket above.
template <int D, bool Masked, class Floor, class Change>
void write_bases(const Context& x, const double* __restrict L, double* const* out, Floor floor,
                 Change change) {
  double* __restrict b0 = out[0];
  double* __restrict b1 = out[1];
  double* __restrict b2 = D > 2 ? out[2] : out[1];
#pragma GCC ivdep
  for (int i = 0; i < x.n; ++i) {
    const double m = Masked ? x.mask[i] : 1.0;
    const double t0 = m * change(0, i), t1 = m * change(1, i);
    if constexpr (D == 2) {
      b0[i] = floor(L[i] - t1, i);
      b1[i] = floor(L[i] - t0, i);
    } else {
      const double t2 = m * change(2, i);
      b0[i] = floor(L[i] - (t1 + t2), i);
      b1[i] = floor(L[i] - (t0 + t2), i);
      b2[i] = floor(L[i] - (t0 + t1), i);
    }
  }
}

template <int D, int C, bool Masked>
void base_rows(const Row& row, const RemapBaseHandles& h, const Axes& axes, Vec3 gravity,
               bool scaled) {
  Context x;
  x.n = row.whole_vectors();
  x.mask = Masked ? row(h.mask) : nullptr;
  const double* su[3];
  const double* sp[3];
  for (int t = 0; t < D; ++t) {
    const double dx = row.step().spacing[axes.direction[t]];
    x.h[t] = 0.5 * row.step().dt / dx;
    x.g_dx[t] = gravity[axes.direction[t]] * dx;
    x.u[t] = row(h.velocity, t);
    su[t] = row(h.velocity_slope, t);
    sp[t] = row(h.pressure_slope, t);
  }
  auto outputs = [&](int component, double** out) {
    for (int d = 0; d < D; ++d) out[d] = row(h.base[static_cast<std::size_t>(d)], component);
  };
  double* out[3];
  outputs(0, out);
  const Quantity rho = quantity<D>(row, h.rho, 0);
  const double* rho_L = row(h.rho_L);
  write_bases<D, Masked>(x, rho_L, out, TenthOf{rho_L}, [&](int t, int i) {
    return advected(rho, x, t, i) - x.h[t] * rho.centre[i] * su[t][i];
  });
  outputs(1, out);
  const Quantity E = quantity<D>(row, h.energy, 0);
  const double* p = row(h.pressure);
  const auto change_of_energy = [&](int t, int i) {
    return advected(E, x, t, i) - x.h[t] * (E.centre[i] + p[i]) * su[t][i];
  };
  const double* energy_L = row(h.energy_L);
  if (scaled)
    write_bases<D, Masked>(x, energy_L, out, BelowBy{energy_L, row(h.energy_scale)},
                           change_of_energy);
  else
    write_bases<D, Masked>(x, energy_L, out, TenthOf{energy_L}, change_of_energy);
  const double* w = row(h.inverse_rho);
  for (int c = 0; c < C; ++c) {
    outputs(2 + c, out);
    const Quantity u = quantity<D>(row, h.velocity, c);
    write_bases<D, Masked>(x, row(h.velocity_L, c), out, NoFloor{}, [&](int t, int i) {
      const double put = t == c ? x.h[t] * (w[i] * sp[t][i] + x.g_dx[t]) : 0.0;
      return advected(u, x, t, i) - put;
    });
  }
}

inline RemapBaseHandles declare_remap_bases(TaskBuilder& task, const SchemeVariables& v,
                                            const SchemeOptions& o) {
  RemapBaseHandles h;
  h.rho = task.read(v.rho, Stencil::box(1));
  h.energy = task.read(v.energy, Stencil::box(1));
  h.velocity = task.read(v.velocity, Stencil::box(1));
  h.pressure = task.read(v.pressure);
  h.inverse_rho = task.read(v.inverse_rho);
  h.velocity_slope = task.read(v.velocity_slope);
  h.pressure_slope = task.read(v.pressure_slope);
  if (o.masked) h.mask = task.read(v.mask);
  h.rho_L = task.read(v.rho_L);
  h.energy_L = task.read(v.energy_L);
  h.velocity_L = task.read(v.velocity_L);
  if (o.mixture || o.fluid.ideal() == nullptr) h.energy_scale = task.read(v.energy_scale);
  for (int d = 0; d < o.axes.count; ++d)
    h.base[static_cast<std::size_t>(d)] = task.write(v.base[static_cast<std::size_t>(d)]);
  return h;
}

}  // namespace sluice::ice
