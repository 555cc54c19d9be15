// Steps 2 and 3 of the third order: parabolas of density, velocity and pressure in each cell, and
// the states at its edges in the middle of the step.
//
// Along axis d, at the high edge (at the low one in the mirror), l = dt/dx, shares of the cell
//   s+ = l max(0, u + c),  s0 = l max(0, u),  s- = l max(0, u - c)
// end at the edge; q(s) is the mean of the parabola of q over such a share, less that of the cell.
// What the fastest wave brings is the reference; the others take from it where they arrive:
//   b- = ((p(s+) - p(s-))/c^2 - (u(s+) - u(s-)) rho/c)/2              where u > c
//   b0 = (rho(s+) - rho(s0)) - (p(s+) - p(s0))/c^2                    where u > 0
//   rho + rho(s+) - b- - b0,  u + u(s+) + b- c/rho,  p + p(s+) - b- c^2,  u_t + u_t(s0)
// (Colella, Woodward, J. Comput. Phys. 54 (1984) 174, with one reference). Then half a step of
// what flows along the other axes t, with the rise a_t = low + high of the parabolas along t and
// h_t = dt/(2 dx_t):
//   rho: -h_t (u_t a_t(rho) + rho a_t(u_t)),   u_c: -h_t (u_t a_t(u_c) + [c = t] a_t(p)/rho)
//   p: -h_t (u_t a_t(p) + rho c^2 a_t(u_t)),   E: -h_t (u_t a_t(E) + (E + p) a_t(u_t))
// E is traced for laws other than that of an ideal gas, like rho, with h = (E + p)/rho for 1.
// Under gravity the differences of p are those from the discrete hydrostatic balance
// p_{i+1} - p_i = g dx (rho_i + rho_{i+1})/2 + f dx: a column at rest has no rise; the edge gets
// the weight of half a cell, and the flow carries the whole pressure. A state with less than a
// twentieth of the density or the pressure of its cell falls back to the mean; cells that a redone
// step masks have no rises.
#include "ice/parabolas/parabola.hpp"
#include "ice/parabolas/tasks.hpp"

namespace sluice::ice {
namespace {

// threshold: smallest share of the density and the pressure (above the lowest one of its law) of
//   its cell that a traced state has; else it is the mean; unit: 1; test:
//   StrongWaves.StayPositive
constexpr double min_share = 0.05;
// Cells whose parabolas are held at a time: they stay in the innermost cache.
constexpr int batch = 32;

struct Handles {
  In rho, energy, mask, velocity, pressure, sound, inverse_rho;
  std::array<Out, 3> traced;
};

template <int D>
struct Constants {
  double l[D], h[D], g_dx[D], f_dx[D];  // dt/dx and its half, s/m; Pa m^3/kg; Pa
  double pi = 0;                        // minus the lowest pressure of the law

  Constants(const SchemeOptions& o, const StepConstants& step)
      : pi(-o.materials.fluid.lowest_pressure()) {
    for (int d = 0; d < D; ++d) {
      const int direction = o.grid.axes.direction[d];
      const double dx = step.spacing[direction];
      l[d] = step.dt / dx;
      h[d] = 0.5 * l[d];
      g_dx[d] = o.forces.gravity[direction] * dx;
      f_dx[d] = o.forces.driving[direction] * dx;
    }
  }
};

// Rises of Q quantities along D axes in a batch of cells: density, velocity, pressure, energy.
template <int D, int Q>
struct Rises {
  double low[D][Q][batch], high[D][Q][batch];
};

// Means of a quantity in a row and in the rows two cells around along an axis.
struct FiveRows {
  const double *mm, *m, *c, *p, *pp;

  FiveRows(const Row& row, In in, int component, int axis, int first)
      : mm(row(in, component, axis, -2) + first),
        m(row(in, component, axis, -1) + first),
        c(row(in, component) + first),
        p(row(in, component, axis, 1) + first),
        pp(row(in, component, axis, 2) + first) {}
};

void rise_rows(const FiveRows& q, int n, double* __restrict low, double* __restrict high) {
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    const Parabola a =
        parabola(q.m[i] - q.mm[i], q.c[i] - q.m[i], q.p[i] - q.c[i], q.pp[i] - q.p[i]);
    low[i] = a.low;
    high[i] = a.high;
  }
}

// Of the pressure beyond hydrostatic balance.
void rise_rows_under_weight(const FiveRows& q, const FiveRows& r, double g_dx, double f_dx, int n,
                            double* __restrict low, double* __restrict high) {
  const double half = 0.5 * g_dx;
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    const Parabola a = parabola((q.m[i] - q.mm[i]) - (half * (r.mm[i] + r.m[i]) + f_dx),
                                (q.c[i] - q.m[i]) - (half * (r.m[i] + r.c[i]) + f_dx),
                                (q.p[i] - q.c[i]) - (half * (r.c[i] + r.p[i]) + f_dx),
                                (q.pp[i] - q.p[i]) - (half * (r.p[i] + r.pp[i]) + f_dx));
    low[i] = a.low;
    high[i] = a.high;
  }
}

// The cells of a batch: `first` of the row and `n` from there on.
template <int D, int C, bool Scaled>
class Batch {
 public:
  static constexpr int pressure = 1 + C, energy = 2 + C, quantities = C + (Scaled ? 3 : 2);

  Batch(const Row& row, const Handles& h, const Constants<D>& k, int first, int n)
      : k_(k),
        n_(n),
        rho_(row(h.rho) + first),
        w_(row(h.inverse_rho) + first),
        p_(row(h.pressure) + first),
        c_(row(h.sound) + first),
        E_(Scaled ? row(h.energy) + first : nullptr) {
    for (int c = 0; c < C; ++c) u_[c] = row(h.velocity, c) + first;
  }

  template <bool Weight>
  void find_rises(const Row& row, const Handles& h, int first) {
    for (int d = 0; d < D; ++d)
      for (int q = 0; q < quantities; ++q) {
        double *low = rises_.low[d][q], *high = rises_.high[d][q];
        if (Weight && q == pressure) {
          rise_rows_under_weight({row, h.pressure, 0, d, first}, {row, h.rho, 0, d, first},
                                 k_.g_dx[d], k_.f_dx[d], n_, low, high);
          continue;
        }
        const bool is_velocity = q > 0 && q < pressure;
        const In in = q == 0          ? h.rho
                      : is_velocity   ? h.velocity
                      : q == pressure ? h.pressure
                                      : h.energy;
        rise_rows({row, in, is_velocity ? q - 1 : 0, d, first}, n_, low, high);
      }
  }
  void mask(const double* mask) {
    for (int d = 0; d < D; ++d)
      for (int q = 0; q < quantities; ++q)
        for (double* rise : {rises_.low[d][q], rises_.high[d][q]})
          for (int i = 0; i < n_; ++i) rise[i] *= mask[i];
  }

  // What flows along axis t changes in half a step.
  template <bool Weight>
  void find_changes(int t) {
    const auto rise = [&](int q, int i) { return rises_.low[t][q][i] + rises_.high[t][q][i]; };
    const double h = k_.h[t], g_dx = k_.g_dx[t], f_dx = k_.f_dx[t];
#pragma GCC ivdep
    for (int i = 0; i < n_; ++i) {
      const double u = u_[t][i], stretch = rise(1 + t, i), rise_p = rise(pressure, i);
      change_[t][0][i] = h * (u * rise(0, i) + rho_[i] * stretch);
      for (int c = 0; c < C; ++c)
        change_[t][1 + c][i] = h * (u * rise(1 + c, i) + (c == t ? w_[i] * rise_p : 0.0));
      const double carried = Weight ? rise_p + (g_dx * rho_[i] + f_dx) : rise_p;
      change_[t][pressure][i] = h * (u * carried + rho_[i] * (c_[i] * c_[i]) * stretch);
      if constexpr (Scaled)
        change_[t][energy][i] = h * (u * rise(energy, i) + (E_[i] + p_[i]) * stretch);
    }
  }

  // The states at the high or the low edges along axis d.
  template <int d, bool High, bool Weight>
  void trace(double* const* out) const {
    constexpr double sign = High ? 1.0 : -1.0;
    const double l = k_.l[d], pi = k_.pi;
    const double weight = 0.5 * sign * k_.g_dx[d], push = 0.5 * sign * k_.f_dx[d];
#pragma GCC ivdep
    for (int i = 0; i < n_; ++i) {
      const auto mean = [&](int q, double s) {
        const double low = rises_.low[d][q][i], high = rises_.high[d][q][i];
        return High ? mean_at_high_edge(low, high, s) : mean_at_low_edge(low, high, s);
      };
      const double c = c_[i], c2 = c * c, inverse_c2 = 1.0 / c2, leaving = sign * u_[d][i];
      const double fast = share(l * (leaving + c)), middle = share(l * leaving),
                   slow = share(l * (leaving - c));
      const double r1 = mean(0, fast), u1 = mean(1 + d, fast), p1 = mean(pressure, fast);
      const double p0 = leaving > 0.0 ? (p1 - mean(pressure, middle)) * inverse_c2 : 0.0;
      const double r0 = leaving > 0.0 ? r1 - mean(0, middle) : 0.0;
      const double against = 0.5 * ((p1 - mean(pressure, slow)) * inverse_c2 -
                                    sign * (u1 - mean(1 + d, slow)) * (rho_[i] * c * inverse_c2));
      const double b = leaving > c ? against : 0.0;
      const double rho = (rho_[i] + (r1 - (r0 - p0) - b)) - across(d, 0, i);
      double p = (p_[i] + (p1 - b * c2)) - across(d, pressure, i);
      if constexpr (Weight) p -= k_.h[d] * u_[d][i] * (k_.g_dx[d] * rho_[i] + k_.f_dx[d]);
      const bool good = (rho > min_share * rho_[i]) & (p + pi > min_share * (p_[i] + pi));
      out[0][i] = good ? rho : rho_[i];
      for (int q = 0; q < C; ++q) {
        const double u = q == d ? u1 + sign * (b * c * w_[i]) : mean(1 + q, middle);
        out[1 + q][i] = good ? (u_[q][i] + u) - across(d, 1 + q, i) : u_[q][i];
      }
      double edge = good ? p : p_[i];
      if constexpr (Weight) edge += weight * rho_[i] + push;
      out[pressure][i] = edge;
      if constexpr (Scaled) {
        const double e1 = mean(energy, fast), enthalpy = (E_[i] + p_[i]) * w_[i];
        const double e0 = leaving > 0.0 ? e1 - mean(energy, middle) : 0.0;
        const double E =
            (E_[i] + (e1 - (e0 - p0 * enthalpy) - b * enthalpy)) - across(d, energy, i);
        out[energy][i] = good ? E : E_[i];
      }
    }
  }

 private:
  static double share(double s) { return smaller(larger(0.0, s), 1.0); }
  // Of the axes other than d: two of them are summed first, so that they may change places.
  [[gnu::always_inline]] double across(int d, int q, int i) const {
    if constexpr (D == 1) return 0.0;
    if constexpr (D == 2) return change_[1 - d][q][i];
    return change_[d == 0 ? 1 : 0][q][i] + change_[d == 2 ? 1 : 2][q][i];
  }

  Constants<D> k_;
  int n_;
  const double *rho_, *w_, *p_, *c_, *E_, *u_[C];
  Rises<D, quantities> rises_;
  double change_[D][quantities][batch];
};

template <int D, int C, bool Scaled, bool Weight, int d>
void trace_axis(const Batch<D, C, Scaled>& cells, const Row& row, Out traced, int first) {
  constexpr int Q = Batch<D, C, Scaled>::quantities;
  double *high[Q], *low[Q];
  for (int q = 0; q < Q; ++q) {
    high[q] = row(traced, q) + first;
    low[q] = row(traced, Q + q) + first;
  }
  cells.template trace<d, true, Weight>(high);
  cells.template trace<d, false, Weight>(low);
}

template <int D, int C, bool Scaled, bool Weight>
void trace_row(const Row& row, const Handles& h, const Constants<D>& k, bool masked) {
  const int all = row.count();
  for (int first = 0; first < all; first += batch) {
    const int n = all - first < batch ? all - first : batch;
    Batch<D, C, Scaled> cells(row, h, k, first, n);
    cells.template find_rises<Weight>(row, h, first);
    if (masked) cells.mask(row(h.mask) + first);
    if constexpr (D > 1)
      for (int t = 0; t < D; ++t) cells.template find_changes<Weight>(t);
    trace_axis<D, C, Scaled, Weight, 0>(cells, row, h.traced[0], first);
    if constexpr (D > 1) trace_axis<D, C, Scaled, Weight, 1>(cells, row, h.traced[1], first);
    if constexpr (D > 2) trace_axis<D, C, Scaled, Weight, 2>(cells, row, h.traced[2], first);
  }
}

template <int D, int C>
void trace_row_of(const Row& row, const Handles& h, const SchemeOptions& o) {
  const Constants<D> k(o, row.step());
  const bool scaled = o.materials.fluid.gamma_law() == nullptr, masked = o.scheme.masked;
  if (scaled)
    o.forces.on ? trace_row<D, C, true, true>(row, h, k, masked)
                : trace_row<D, C, true, false>(row, h, k, masked);
  else
    o.forces.on ? trace_row<D, C, false, true>(row, h, k, masked)
                : trace_row<D, C, false, false>(row, h, k, masked);
}

}  // namespace

void add_traced_states(TaskList& list, const TracedStatesInput& v, const SchemeOptions& o,
                       int effect) {
  TaskBuilder task = list.task("parabolas", effect);
  Stencil around;
  for (int a = 0; a < o.grid.axes.count; ++a) {
    around.low[o.grid.axes.direction[a]] = 2;
    around.high[o.grid.axes.direction[a]] = 2;
  }
  Handles h;
  h.rho = task.read(v.rho, around);
  h.velocity = task.read(v.velocity, around);
  h.pressure = task.read(v.pressure, around);
  if (TracedComponents::of(o).energy) h.energy = task.read(v.energy, around);
  h.sound = task.read(v.sound);
  h.inverse_rho = task.read(v.inverse_rho);
  if (o.scheme.masked) h.mask = task.read(v.mask);
  for (int a = 0; a < o.grid.axes.count; ++a) h.traced[a] = task.write(v.traced[a]);
  dispatch(o.grid.axes.count, o.grid.components, [&]<int D, int C>() {
    task.kernel([=](const Row& row) { trace_row_of<D, C>(row, h, o); });
  });
}

}  // namespace sluice::ice
