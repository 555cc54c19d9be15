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

// Bases of one row, quantity by quantity.
template <int D, bool Masked>
class BaseRows {
 public:
  BaseRows(const Row& row, const RemapBaseHandles& h, const Axes& axes)
      : row_(row), h_(h), axes_(axes) {
    x_.n = row.whole_vectors();
    x_.mask = Masked ? row(h.mask) : nullptr;
    for (int t = 0; t < D; ++t) {
      x_.h[t] = 0.5 * row.step().dt / row.step().spacing[axes.direction[t]];
      x_.u[t] = row(h.velocity, t);
      su_[t] = row(h.velocity_slope, t);
    }
  }

  void density() const {
    const Quantity rho = quantity<D>(row_, h_.rho, 0);
    const double* L = row_(h_.rho_L);
    write(0, L, TenthOf{L}, [x = x_, su = su_, rho](int t, int i) {
      return advected(rho, x, t, i) - x.h[t] * rho.centre[i] * su[t][i];
    });
  }
  // `scaled`: not of an ideal gas.
  void energy(bool scaled) const {
    const Quantity E = quantity<D>(row_, h_.energy, 0);
    const double *L = row_(h_.energy_L), *p = row_(h_.pressure);
    const auto change = [x = x_, su = su_, E, p](int t, int i) {
      return advected(E, x, t, i) - x.h[t] * (E.centre[i] + p[i]) * su[t][i];
    };
    if (scaled)
      write(1, L, BelowBy{L, row_(h_.energy_scale)}, change);
    else
      write(1, L, TenthOf{L}, change);
  }
  template <int C>
  void velocity(Vec3 gravity) const {
    const double* w = row_(h_.inverse_rho);
    std::array<const double*, 3> sp{};
    std::array<double, 3> g_dx{};
    for (int t = 0; t < D; ++t) {
      sp[static_cast<std::size_t>(t)] = row_(h_.pressure_slope, t);
      const int direction = axes_.direction[t];
      g_dx[static_cast<std::size_t>(t)] = gravity[direction] * row_.step().spacing[direction];
    }
    for (int c = 0; c < C; ++c) {
      const Quantity u = quantity<D>(row_, h_.velocity, c);
      write(2 + c, row_(h_.velocity_L, c), NoFloor{}, [x = x_, sp, g_dx, w, u, c](int t, int i) {
        const auto k = static_cast<std::size_t>(t);
        const double put = t == c ? x.h[t] * (w[i] * sp[k][i] + g_dx[k]) : 0.0;
        return advected(u, x, t, i) - put;
      });
    }
  }

 private:
  template <class Floor, class Change>
  void write(int component, const double* L, Floor floor, Change change) const {
    double* out[3];
    for (int d = 0; d < D; ++d) out[d] = row_(h_.base[static_cast<std::size_t>(d)], component);
    write_bases<D, Masked>(x_, L, out, floor, change);
  }

  const Row& row_;
  const RemapBaseHandles& h_;
  const Axes& axes_;
  Context x_;
  std::array<const double*, 3> su_{};
};

template <int D, int C, bool Masked>
void base_rows(const Row& row, const RemapBaseHandles& h, const Axes& axes, Vec3 gravity,
               bool scaled) {
  const BaseRows<D, Masked> rows(row, h, axes);
  rows.density();
  rows.energy(scaled);
  rows.template velocity<C>(gravity);
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
