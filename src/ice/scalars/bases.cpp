// What each cell offers of a scalar to the faces, and between which values.
//
//   base_d = q - sum_{t != d} h_t u_t L3_t(q) + (dt/2) S        h = dt/(2 dx)
//   half   = q - sum_t h_t u_t L3_t(q) + (dt/2) S               for the diffusive flux
//   S      = sum_t D (M_t+ (q_t+ - q) - M_t- (q - q_t-))/(M dx_t^2),  M_f = 2 M_a M_b/(M_a + M_b)
// with the cell's own D, where species spread; lowest, highest: of the cell and its neighbours
// across faces
// One that is carried by volume offers the amount A = rho q, as density and energy are offered:
//   base_d = rho_L q - sum_{t != d} h_t (u_t L3_t(A) - A su_t)
// A scalar is nowhere but where its material is: neighbours without mass do not count.
#include "ice/fluid/limiters.hpp"
#include "ice/scalars/rows.hpp"
#include "ice/scalars/variables.hpp"

namespace sluice::ice::scalars {
namespace {

constexpr int max_cells = 64;  // of a part of a row

struct Handles {
  std::vector<In> q, mass;  // by scalar
  In velocity, mask, rho_L, velocity_slope;
  In diffusivity;                    // of species
  std::vector<char> by_volume, law;  // by scalar; law: of its diffusivity
  std::vector<int> moves;            // by scalar: first component of its velocity
  Out base, half;
};

struct Constants {
  double h[3];          // dt/(2 dx)
  double diffusion[3];  // dt/(2 dx^2), times D
  const double* velocity[3];
  const double* mask = nullptr;         // may be null
  const double* diffusivity = nullptr;  // of cells, times the number above; may be null
};

template <int D>
struct Around {
  const double *q, *M;
  const double *qm[D], *qp[D], *Mm[D], *Mp[D];

  Around(const Row& row, In scalar, In mass) : q(row(scalar)), M(row(mass)) {
    for (int t = 0; t < D; ++t) {
      qm[t] = row(scalar, 0, t, -1);
      qp[t] = row(scalar, 0, t, 1);
      Mm[t] = row(mass, 0, t, -1);
      Mp[t] = row(mass, 0, t, 1);
    }
  }
};

template <int D>
void bounds_row(const Around<D>& a, int n, double* __restrict low, double* __restrict high) {
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    double least = a.q[i], most = a.q[i];
    for (int t = 0; t < D; ++t) {
      const double below = a.Mm[t][i] > 0.0 ? a.qm[t][i] : a.q[i];
      const double above = a.Mp[t][i] > 0.0 ? a.qp[t][i] : a.q[i];
      least = smaller(least, smaller(below, above));
      most = larger(most, larger(below, above));
    }
    low[i] = least;
    high[i] = most;
  }
}

// change[t] = h u L3(q) along t, spread = (dt/2) S.
template <int D>
void change_rows(const Around<D>& a, const Constants& x, int n, bool diffusive,
                 double (*change)[max_cells], double* __restrict spread) {
  for (int t = 0; t < D; ++t) {
    const double h = x.h[t];
    const double* __restrict u = x.velocity[t];
    double* __restrict to = change[t];
#pragma GCC ivdep
    for (int i = 0; i < n; ++i) {
      const double below = difference(a.qm[t][i], a.q[i], a.Mm[t][i], a.M[i]);
      const double above = difference(a.q[i], a.qp[t][i], a.M[i], a.Mp[t][i]);
      to[i] = h * u[i] * central_slope(below, above);
    }
    if (x.mask != nullptr)
      for (int i = 0; i < n; ++i) to[i] *= x.mask[i];
  }
  for (int i = 0; i < n; ++i) spread[i] = 0.0;
  if (!diffusive) return;
  for (int i = 0; i < n; ++i) {
    double sum = 0;
    for (int t = 0; t < D; ++t) {
      const double above = shared_mass(a.M[i], a.Mp[t][i]) * (a.qp[t][i] - a.q[i]);
      const double below = shared_mass(a.Mm[t][i], a.M[i]) * (a.q[i] - a.qm[t][i]);
      sum += x.diffusion[t] * (above - below);
    }
    spread[i] = sum / larger(a.M[i], min_divisor);
  }
  if (x.diffusivity == nullptr) return;
  for (int i = 0; i < n; ++i) spread[i] *= x.diffusivity[i];
}

// The amounts that are offered along each axis.
template <int D>
void amount_rows(const Row& row, const Handles& h, const Constants& x, const Around<D>& a,
                 int first) {
  const int n = row.count();
  const double* rho_L = row(h.rho_L);
  double change[D][max_cells];
  for (int t = 0; t < D; ++t) {
    const double* su = D > 1 ? row(h.velocity_slope, t) : nullptr;
    const double* u = x.velocity[t];
    for (int i = 0; i < n; ++i) {
      const double A = a.M[i] * a.q[i];
      const double below = A - a.Mm[t][i] * a.qm[t][i], above = a.Mp[t][i] * a.qp[t][i] - A;
      const double strain = D > 1 ? A * su[i] : 0.0;
      change[t][i] = x.h[t] * (u[i] * central_slope(below, above) - strain);
      if (x.mask != nullptr) change[t][i] *= x.mask[i];
    }
  }
  for (int d = 0; d < D; ++d) {
    double* to = row(h.base, first + offered + d);
    const double* c1 = D == 1 ? nullptr : change[d == 0 ? 1 : 0];
    const double* c2 = D < 3 ? nullptr : change[d == 2 ? 1 : 2];
    for (int i = 0; i < n; ++i) {
      const double across = c2 != nullptr ? c1[i] + c2[i] : c1 != nullptr ? c1[i] : 0.0;
      to[i] = rho_L[i] * a.q[i] - across;
    }
  }
}

template <int D>
void base_rows(const Row& row, const Handles& h, const Constants& x, std::size_t k,
               bool diffusive) {
  const int n = row.count(), first = static_cast<int>(k) * (offered + D);
  const Around<D> around(row, h.q[k], h.mass[k]);
  bounds_row(around, n, row(h.base, first + lowest), row(h.base, first + highest));
  double change[D][max_cells], spread[max_cells];
  change_rows(around, x, n, diffusive, change, spread);
  const double* q = around.q;
  for (int d = 0; d < D; ++d) {
    double* __restrict to = row(h.base, first + offered + d);
    // The two others are added first: exchanging axes leaves no trace.
    const double* c1 = D == 1 ? nullptr : change[d == 0 ? 1 : 0];
    const double* c2 = D < 3 ? nullptr : change[d == 2 ? 1 : 2];
    for (int i = 0; i < n; ++i) {
      const double across = c2 != nullptr ? c1[i] + c2[i] : c1 != nullptr ? c1[i] : 0.0;
      to[i] = (q[i] - across) + spread[i];
    }
  }
  if (h.by_volume[k] != 0) amount_rows(row, h, x, around, first);
  if (h.half.index < 0) return;
  double* __restrict half = row(h.half, static_cast<int>(k));
  for (int i = 0; i < n; ++i) {
    double moved = change[0][i];
    for (int t = 1; t < D; ++t) moved += change[t][i];
    half[i] = (q[i] - moved) + spread[i];
  }
}

}  // namespace

void add_bases(TaskList& list, const FlowOfScalars& v, const SchemeOptions& o, int effect) {
  if (!o.scheme.second_order) return;
  TaskBuilder task = list.task("scalar bases", effect);
  Handles h;
  std::vector<double> diffusivity;
  for (const ScalarVariables::Each& e : v.scalars.each) {
    h.q.push_back(task.read(e.old, Stencil::box(1)));
    h.mass.push_back(task.read(e.mass, Stencil::box(1)));
    const models::TransportedScalar& scalar = o.materials.scalars[e.index];
    diffusivity.push_back(scalar.spreads_by_law ? 1.0 : scalar.diffusivity);
    h.moves.push_back(o.materials.mixture && o.materials.multi_velocity
                          ? scalar.material * o.grid.components
                          : 0);
  }
  for (const ScalarVariables::Each& e : v.scalars.each) {
    h.by_volume.push_back(o.materials.scalars[e.index].by_volume ? 1 : 0);
    h.law.push_back(o.materials.scalars[e.index].spreads_by_law ? 1 : 0);
  }
  if (o.materials.mixed != nullptr) {
    h.rho_L = task.read(v.rho_L);
    h.velocity_slope = task.read(v.velocity_slope);
  }
  if (o.transport.spreads_species) h.diffusivity = task.read(v.scalars.diffusivity);
  h.velocity = task.read(v.velocity);
  const bool masked = o.scheme.masked || v.scalars.walls.has_cut_cells;
  if (masked) h.mask = task.read(v.scalars.walls.has_cut_cells ? v.scalars.walls.slopes : v.mask);
  h.base = task.write(v.scalars.base);
  if (v.scalars.diffusive) h.half = task.write(v.scalars.half);
  dispatch(o.grid.axes.count, o.grid.components, [&]<int D, int C>() {
    task.kernel([=, axes = o.grid.axes](const Row& row) {
      for (int begin = 0; begin < row.count(); begin += max_cells) {
        const int left = row.count() - begin;
        const Row part = row.part(begin, left < max_cells ? left : max_cells);
        Constants x;
        if (masked) x.mask = part(h.mask);
        for (std::size_t k = 0; k < h.q.size(); ++k) {
          for (int t = 0; t < D; ++t) {
            const double dx = part.step().spacing[axes.direction[t]];
            x.h[t] = 0.5 * part.step().dt / dx;
            x.diffusion[t] = x.h[t] / dx * diffusivity[k];
            x.velocity[t] = part(h.velocity, h.moves[k] + t);
          }
          x.diffusivity = h.law[k] != 0 ? part(h.diffusivity, static_cast<int>(k)) : nullptr;
          base_rows<D>(part, h, x, k, diffusivity[k] > 0);
        }
      }
    });
  });
}

}  // namespace sluice::ice::scalars
