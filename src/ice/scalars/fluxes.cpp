// What a scalar is where mass passes a face, and what spreads through it.
//
// With the donor's values, F the mass that passes, f = min(|F|/M, .99), s = sign(F),
// nu = |H|/J, H = l u_f, N the outflow Courant number:
//   q_f = base + s (1-f)/2 Q3(D q; f, 2), between the lowest and highest value around, and
//   q_f - q <= r (q - lowest),  q - q_f <= r (highest - q),  r = nu M/(N |F|) - 1
// The share nu/N of the donor's mass stands behind this face, and F is no more than that
// (remap_flux_rows.hpp): what stays of the share is between the same bounds, so that no step makes
// a new extremum. Diffusion: dt D M_f (half_a - half_b)/dx^2, see bases.cpp, where a material that
// does not fill its cell counts with what surely stays there in this step: all of it may leave.
// Beside solids the open share of a face lets pass what spreads; a cell that they touch gives
// its q.
#include "ice/fluid/limiters.hpp"
#include "ice/scalars/rows.hpp"
#include "ice/scalars/variables.hpp"
#include "ice/step/remap_bounds.hpp"

namespace sluice::ice::scalars {
namespace {

struct Each {
  In q, mass, volume;
  In density;  // mass that what spreads follows: per volume of fluid
  int carrier = 0, place = 0;
  int motion = 0;  // component of face velocity and outflow
  double diffusivity = 0;
  bool law = false;  // of species: times the mean of the two cells' own
  bool by_volume = false;
};

struct Handles {
  std::vector<Each> each;
  In carrier, face_velocity, inverse_J, courant, base, half, mask;
  In pure;         // of a mixture with a mixed gas
  In open;         // share of the face; beside solids
  In diffusivity;  // of species
  Out face, spread;
};

struct Pair {  // of the cells on both sides
  const double *a, *b;
};

// threshold: how much further than the donor's value a face may be, at most: any number that
//   leaves products finite; unit: 1; test: none
constexpr double max_leeway = 1e30;

// How much further than the donor's value a face may be, as a share of what the donor's value is
// away from the other bound.
inline double leeway(double nu, double M, double flow, double N) {
  const double r = nu * M / larger(flow * N, min_divisor) - 1.0;
  return smaller(larger(r, 0.0), max_leeway);
}

inline double bounded(double value, double q, double low, double high, double r) {
  value = larger(smaller(value, q + r * (q - low)), q - r * (high - q));
  return larger(smaller(value, high), low);
}

template <bool Masked>
void face_row(const Row& row, const Handles& h, const Each& e, int axis, int axes, double l) {
  const int n = row.count(), first = e.place * (offered + axes);
  const auto cells = [&](In in, int c = 0) { return Pair{row(in, c, axis, -1), row(in, c)}; };
  const Pair low = cells(h.base, first + lowest), high = cells(h.base, first + highest);
  const Pair base = cells(h.base, first + offered + axis);
  const Pair iJ = cells(h.inverse_J), N = cells(h.courant, e.motion);
  const Pair mask = Masked ? cells(h.mask) : iJ;
  const double* __restrict qmm = row(e.q, 0, axis, -2);
  const double* __restrict qm = row(e.q, 0, axis, -1);
  const double* __restrict qp = row(e.q, 0, axis, 0);
  const double* __restrict qpp = row(e.q, 0, axis, 1);
  const double* __restrict Mmm = row(e.mass, 0, axis, -2);
  const double* __restrict Mm = row(e.mass, 0, axis, -1);
  const double* __restrict Mp = row(e.mass, 0, axis, 0);
  const double* __restrict Mpp = row(e.mass, 0, axis, 1);
  const double* __restrict F = row(h.carrier, e.carrier);
  const double* __restrict uf = row(h.face_velocity, e.motion);
  double* __restrict face = row(h.face, e.place);
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    const double H = l * uf[i];
    const bool left = H < 0.0;
    const double q = left ? qp[i] : qm[i];
    const double M = left ? Mp[i] : Mm[i];
    const double lo = left ? low.b[i] : low.a[i], hi = left ? high.b[i] : high.a[i];
    const double flow = std::fabs(F[i]);
    const double f = smaller(flow / larger(M, min_divisor), max_mass_passing);
    const double nu = std::fabs(H) * (left ? iJ.b[i] : iJ.a[i]);
    const double r = leeway(nu, M, flow, left ? N.b[i] : N.a[i]);
    const double middle = difference(qm[i], qp[i], Mm[i], Mp[i]);
    const double outer =
        left ? difference(qp[i], qpp[i], Mp[i], Mpp[i]) : difference(qmm[i], qm[i], Mmm[i], Mm[i]);
    const double half_sign = left ? -0.5 : 0.5;
    const double m = Masked ? (left ? mask.b[i] : mask.a[i]) : 1.0;
    const double value = (left ? base.b[i] : base.a[i]) +
                         half_sign * (1.0 - f) * m * upwind_slope(outer, middle, f, 2.0);
    face[i] = bounded(value, q, lo, hi, r);
  }
}

// Carried by volume: the amount A = rho q on the face, bounded as density and energy are, over the
// density on the face, F/H:
//   A_s = base + s (1-nu)/2 Q3(D A; nu, 2)/J
template <bool Masked>
void amount_row(const Row& row, const Handles& h, const Each& e, int axis, int axes, double l) {
  const int n = row.count(), first = e.place * (offered + axes);
  const auto cells = [&](In in, int c = 0) { return Pair{row(in, c, axis, -1), row(in, c)}; };
  const Pair low = cells(h.base, first + lowest), high = cells(h.base, first + highest);
  const Pair base = cells(h.base, first + offered + axis);
  const Pair iJ = cells(h.inverse_J), N = cells(h.courant, e.motion);
  const Pair mask = Masked ? cells(h.mask) : iJ;
  const double *q[4], *M[4];
  for (int k = 0; k < 4; ++k) {
    q[k] = row(e.q, 0, axis, k - 2);
    M[k] = row(e.mass, 0, axis, k - 2);
  }
  const double* F = row(h.carrier, e.carrier);
  const double* uf = row(h.face_velocity);
  double* face = row(h.face, e.place);
  for (int i = 0; i < n; ++i) {
    const double H = l * uf[i];
    const bool left = H < 0.0;
    const double donor = left ? q[2][i] : q[1][i];
    const double J = left ? iJ.b[i] : iJ.a[i];  // 1/J
    const double m = Masked ? (left ? mask.b[i] : mask.a[i]) : 1.0;
    double A[4];
    for (int k = 0; k < 4; ++k) A[k] = M[k][i] * q[k][i];
    const double nu = std::fabs(H) * J;
    const double slope = upwind_slope(left ? A[3] - A[2] : A[1] - A[0], A[2] - A[1], nu, 2.0);
    const double amount =
        (left ? base.b[i] : base.a[i]) + (left ? -0.5 : 0.5) * (1.0 - nu) * J * m * slope;
    const double value = F[i] != 0.0 ? amount * H / F[i] : donor;
    const double r = leeway(nu, left ? M[2][i] : M[1][i], std::fabs(F[i]), left ? N.b[i] : N.a[i]);
    face[i] = bounded(value, donor, left ? low.b[i] : low.a[i], left ? high.b[i] : high.a[i], r);
  }
}

// First order: the donor's value.
void donor_row(const Row& row, const Handles& h, const Each& e, int axis) {
  const double* __restrict qm = row(e.q, 0, axis, -1);
  const double* __restrict qp = row(e.q);
  const double* __restrict uf = row(h.face_velocity, e.motion);
  double* __restrict face = row(h.face, e.place);
  for (int i = 0; i < row.count(); ++i) face[i] = uf[i] < 0.0 ? qp[i] : qm[i];
}

// Beside other materials the donor's value goes with its density and energy
// (mixture/face_shares.cpp).
void donors_beside_others(const Row& row, const Handles& h, const Each& e, int axis) {
  const double* __restrict pure_a = row(h.pure, 0, axis, -1);
  const double* __restrict pure_b = row(h.pure);
  const double* __restrict qa = row(e.q, 0, axis, -1);
  const double* __restrict qb = row(e.q);
  const double* __restrict uf = row(h.face_velocity, e.motion);
  double* __restrict face = row(h.face, e.place);
#pragma GCC ivdep
  for (int i = 0; i < row.count(); ++i) {
    const bool alone = (int{pure_a[i] == pure_b[i]} & int{pure_b[i] >= 0.0}) != 0;
    const double donor = uf[i] < 0.0 ? qb[i] : qa[i];
    face[i] = alone ? face[i] : donor;
  }
}

// Positive along the axis. Of a scalar that does not spread: nothing.
void spread_row(const Row& row, const Handles& h, const Each& e, int axis, double weight,
                bool second_order) {
  const In q = second_order ? h.half : e.q;
  const int c = second_order ? e.place : 0;
  const double* __restrict qa = row(q, c, axis, -1);
  const double* __restrict qb = row(q, c);
  const double* __restrict Ma = row(e.density, 0, axis, -1);
  const double* __restrict Mb = row(e.density);
  double* __restrict to = row(h.spread, e.place);
  const double D = e.diffusivity * weight;
  if (e.volume.index < 0) {
#pragma GCC ivdep
    for (int i = 0; i < row.count(); ++i) to[i] = D * shared_mass(Ma[i], Mb[i]) * (qa[i] - qb[i]);
    return;
  }
  const double* __restrict Va = row(e.volume, 0, axis, -1);
  const double* __restrict Vb = row(e.volume);
  const double* __restrict Na = row(h.courant, e.motion, axis, -1);
  const double* __restrict Nb = row(h.courant, e.motion);
#pragma GCC ivdep
  for (int i = 0; i < row.count(); ++i) {
    const double stays_a = Ma[i] * staying_share(Va[i], Na[i]);
    const double stays_b = Mb[i] * staying_share(Vb[i], Nb[i]);
    to[i] = D * shared_mass(stays_a, stays_b) * (qa[i] - qb[i]);
  }
}

void law_row(const Row& row, const Handles& h, const Each& e, int axis) {
  const double* __restrict Da = row(h.diffusivity, e.place, axis, -1);
  const double* __restrict Db = row(h.diffusivity, e.place);
  double* __restrict to = row(h.spread, e.place);
  for (int i = 0; i < row.count(); ++i) to[i] *= 0.5 * (Da[i] + Db[i]);
}

void open_row(const Row& row, const Handles& h, const Each& e) {
  const double* __restrict share = row(h.open);
  double* __restrict to = row(h.spread, e.place);
#pragma GCC ivdep
  for (int i = 0; i < row.count(); ++i) to[i] *= share[i];
}

Handles declare(TaskBuilder& task, const FlowOfScalars& v, const SchemeOptions& o, int axis) {
  const int direction = o.grid.axes.direction[axis];
  const Stencil both = Stencil::along(direction, 1, 0);
  const Stencil four = Stencil::along(direction, 2, 1);
  Handles h;
  for (const ScalarVariables::Each& e : v.scalars.each) {
    Each each;
    each.q = task.read(e.old, o.scheme.second_order ? four : both);
    each.mass = task.read(e.mass, o.scheme.second_order ? four : both);
    each.density = v.scalars.walls.has_cut_cells && v.scalars.diffusive ? task.read(e.density, both)
                                                                        : each.mass;
    if (o.materials.mixture && v.scalars.diffusive) each.volume = task.read(e.volume, both);
    each.carrier = e.carrier;
    each.motion = o.materials.mixture && o.materials.multi_velocity ? e.carrier : 0;
    each.place = static_cast<int>(h.each.size());
    each.law = o.materials.scalars[e.index].spreads_by_law;
    each.diffusivity = each.law ? 1.0 : o.materials.scalars[e.index].diffusivity;
    each.by_volume = o.materials.scalars[e.index].by_volume;
    h.each.push_back(each);
  }
  if (o.transport.spreads_species) h.diffusivity = task.read(v.scalars.diffusivity, both);
  h.face_velocity = task.read(v.face_velocity[axis]);
  if (o.scheme.second_order || v.scalars.diffusive) h.courant = task.read(v.courant, both);
  if (o.scheme.second_order) {
    h.carrier = task.read(v.scalars.carrier[axis]);
    h.inverse_J = task.read(v.inverse_J, both);
    h.base = task.read(v.scalars.base, both);
    if (v.scalars.diffusive) h.half = task.read(v.scalars.half, both);
    if (v.scalars.walls.has_cut_cells)
      h.mask = task.read(v.scalars.walls.axis_slopes[axis], both);
    else if (o.scheme.masked)
      h.mask = task.read(v.mask, both);
  }
  if (o.materials.mixture && o.materials.mixed != nullptr) h.pure = task.read(v.pure, both);
  if (v.scalars.walls.has_cut_cells && v.scalars.diffusive)
    h.open = task.read(v.scalars.walls.open_share[axis]);
  h.face = task.write(v.scalars.face[axis]);
  if (v.scalars.diffusive) h.spread = task.write(v.scalars.spread[axis]);
  return h;
}

}  // namespace

void add_fluxes(TaskList& list, const FlowOfScalars& v, const SchemeOptions& o, int effect) {
  static const char* names[] = {"scalars on faces of axis 0", "scalars on faces of axis 1",
                                "scalars on faces of axis 2"};
  for (int axis = 0; axis < o.grid.axes.count; ++axis) {
    TaskBuilder task = list.task(names[axis], effect);
    const Handles h = declare(task, v, o, axis);
    const int direction = o.grid.axes.direction[axis], axes = o.grid.axes.count;
    const bool second = o.scheme.second_order, has_cut_cells = v.scalars.walls.has_cut_cells,
               masked = o.scheme.masked || has_cut_cells, diffusive = v.scalars.diffusive,
               mixture = o.materials.mixture;
    task.kernel([=](const Row& row) {
      const double dx = row.step().spacing[direction], l = row.step().dt / dx;
      for (const Each& e : h.each) {
        if (!second)
          donor_row(row, h, e, axis);
        else if (e.by_volume && masked)
          amount_row<true>(row, h, e, axis, axes, l);
        else if (e.by_volume)
          amount_row<false>(row, h, e, axis, axes, l);
        else if (masked)
          face_row<true>(row, h, e, axis, axes, l);
        else
          face_row<false>(row, h, e, axis, axes, l);
        if (e.by_volume && second && mixture) donors_beside_others(row, h, e, axis);
        if (diffusive) spread_row(row, h, e, axis, l / dx, second);
        if (e.law) law_row(row, h, e, axis);
        if (diffusive && has_cut_cells) open_row(row, h, e);
      }
    });
  }
}

}  // namespace sluice::ice::scalars
