// Step 8: the remap through the faces of each axis; remap_flux_rows.hpp has the formulae.
#include "ice/one_material/remap_flux_rows.hpp"
#include "ice/one_material/tasks.hpp"
#include "ice/step/remap_bounds.hpp"

namespace sluice::ice {
namespace {

// Faces of which the donor's velocities differ by more than its sound: its slope gives what passes
// kinetic energy that internal energy must pay. What the receiver has to pay with is what comes in
// and what mixing the velocities turns into heat,
//
//   th^2 d2/(1-f) <= 2 c e_s/rho_s + mu |v_r - v - th (U - v)|^2,  mu = m_r/(|F| + m_r)
//
// m_r: the receiver's mass that stays. The slope is taken th times, the largest that holds.
template <int D, int C, bool Scaled>
void limit_cold_faces(const Row& row, const RemapFluxHandles& h, int axis, double l) {
  auto a = [&](In in, int c = 0) { return row(in, c, axis, -1); };
  const In energy = Scaled ? h.energy_scale : h.energy_L;
  const double *uf = row(h.face_velocity), *rLa = a(h.rho_L), *rLb = row(h.rho_L);
  const double *sca = a(energy), *scb = row(energy);
  const double *wa = a(h.inverse_rho), *wb = row(h.inverse_rho);
  const double *Na = a(h.courant), *Nb = row(h.courant);
  const double* F = row(h.flux, 0);
  double* G = row(h.flux, 1);
  const double *va[3], *vb[3];
  double* U[3];
  for (int c = 0; c < C; ++c) {
    va[c] = a(h.velocity_L, c);
    vb[c] = row(h.velocity_L, c);
    U[c] = row(h.flux, 2 + c);
  }
  for (int i = 0; i < row.count(); ++i) {
    const bool left = uf[i] * l < 0.0;
    const double rL = chosen(left, rLb[i], rLa[i]), sc = chosen(left, scb[i], sca[i]);
    // As in flux_row: components along axes and carried ones apart.
    double d2 = 0, across = 0, along = 0, carried[3] = {};
    for (int c = 0; c < C; ++c) {
      const double v = chosen(left, vb[c][i], va[c][i]), other = chosen(left, va[c][i], vb[c][i]);
      const double way = U[c][i] - v, jump = other - v;
      (c < D ? d2 : carried[0]) += way * way;
      (c < D ? across : carried[1]) += jump * jump;
      (c < D ? along : carried[2]) += jump * way;
    }
    d2 += carried[0], across += carried[1], along += carried[2];
    if (!(d2 * rL > sc) || F[i] == 0) continue;
    const double f = smaller(std::fabs(F[i]) * chosen(left, wb[i], wa[i]), max_mass_passing);
    const auto K_of = [&](double x) {
      return -0.5 * (x * x * rL) / ((1.0 - f) * (x * rL + 0.25 * sc));
    };
    const double internal = G[i] - F[i] * K_of(d2);
    const double stays =
        (1.0 - smaller(chosen(left, Na[i], Nb[i]), max_mass_passing)) / chosen(left, wa[i], wb[i]);
    const double mu = stays / (std::fabs(F[i]) + stays);
    const double A = d2 / (1.0 - f) - mu * d2, B = mu * along;
    const double paid = larger(0.0, 2 * cold_pays * internal / F[i]) + mu * across;
    const double root = B + std::sqrt(B * B + A * paid);
    if (!(root > paid)) continue;  // th >= 1
    const double theta = paid / root;
    for (int c = 0; c < C; ++c) {
      const double v = chosen(left, vb[c][i], va[c][i]);
      U[c][i] = v + theta * (U[c][i] - v);
    }
    G[i] = internal + F[i] * K_of(theta * theta * d2);
  }
}

// The bound is known when the loop is compiled: a choice in it costs its vectors or its registers;
// so would a call.
template <int D, int C, bool Second, bool Masked, bool Scaled, FaceDensityLimiter Bound>
[[gnu::flatten]] void flux_row(const Row& row, const RemapFluxHandles& h, int axis, double l) {
  const int n = row.whole_vectors();
  auto a = [&](In in, int c = 0) { return row(in, c, axis, -1); };
  constexpr bool based = Second && D > 1;
  const double* __restrict uf = row(h.face_velocity);
  const double* __restrict iJa = a(h.inverse_J);
  const double* __restrict iJb = row(h.inverse_J);
  const double* __restrict rLa = a(h.rho_L);
  const double* __restrict rLb = row(h.rho_L);
  const double* __restrict ELa = a(h.energy_L);
  const double* __restrict ELb = row(h.energy_L);
  const double* __restrict sca = Scaled ? a(h.energy_scale) : ELa;
  const double* __restrict scb = Scaled ? row(h.energy_scale) : ELb;
  const double* __restrict Na = a(h.courant);
  const double* __restrict Nb = row(h.courant);
  const double* __restrict iNa = a(h.inverse_courant);
  const double* __restrict iNb = row(h.inverse_courant);
  const double* __restrict wa = a(h.inverse_rho);
  const double* __restrict wb = row(h.inverse_rho);
  const double* __restrict rBa = based ? a(h.base, 0) : rLa;
  const double* __restrict rBb = based ? row(h.base, 0) : rLb;
  const double* __restrict EBa = based ? a(h.base, 1) : ELa;
  const double* __restrict EBb = based ? row(h.base, 1) : ELb;
  const double* __restrict ma = Masked ? a(h.mask) : rLa;
  const double* __restrict mb = Masked ? row(h.mask) : rLb;
  const Around R = Second ? around(row, h.rho, 0, axis) : Around{};
  const Around E = Second ? around(row, h.energy, 0, axis) : Around{};
  Around V[3];
  const double* va[3];
  const double* vb[3];
  const double* uBa[3];
  const double* uBb[3];
  double* U[3];
  for (int c = 0; c < C; ++c) {
    if (Second) V[c] = around(row, h.velocity, c, axis);
    va[c] = a(h.velocity_L, c);
    vb[c] = row(h.velocity_L, c);
    uBa[c] = based ? a(h.base, 2 + c) : va[c];
    uBb[c] = based ? row(h.base, 2 + c) : vb[c];
    U[c] = row(h.flux, 2 + c);
  }
  double* __restrict F = row(h.flux, 0);
  double* __restrict G = row(h.flux, 1);
  std::uint64_t cold = 0;
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    const double H = l * uf[i];
    const bool left = H < 0.0;
    const double half_sign = left ? -0.5 : 0.5;
    const double iJ = chosen(left, iJb[i], iJa[i]);
    const double rL = chosen(left, rLb[i], rLa[i]);
    const double EL = chosen(left, ELb[i], ELa[i]);
    const double sc = Scaled ? chosen(left, scb[i], sca[i]) : EL;
    double rs = chosen(left, rBb[i], rBa[i]);
    double es = chosen(left, EBb[i], EBa[i]);
    const double m = Masked ? chosen(left, mb[i], ma[i]) : 1.0;
    if constexpr (Second) {
      const double N = chosen(left, Nb[i], Na[i]);
      const double iN = chosen(left, iNb[i], iNa[i]);
      const double nu = std::fabs(H) * iJ;
      const double weight = half_sign * (1.0 - nu) * iJ * m;
      rs +=
          weight * donor_slope(R, i, left, nu, Bound == FaceDensityLimiter::sharp ? 2.0 * iN : 2.0);
      es += weight * donor_slope(E, i, left, nu, 2.0);
      rs = smaller(larger(rs, face_floor * rL), rL * (density_gone + density_left * N) * iN);
      if constexpr (Scaled)
        es = smaller(larger(es, EL - face_drop * sc),
                     EL + sc * ((energy_gone + energy_left * N) * iN - 1.0));
      else
        es = smaller(larger(es, face_floor * EL), EL * (energy_gone + energy_left * N) * iN);
    }
    const double flow = H * rs;
    const double f = smaller(std::fabs(flow) * chosen(left, wb[i], wa[i]), max_mass_passing);
    // Components along axes and carried ones are summed apart: the sum of two does not depend on
    // the order of the axes.
    double d2 = 0.0, carried = 0.0;
    for (int c = 0; c < C; ++c) {
      const double v = chosen(left, vb[c][i], va[c][i]);
      double u = chosen(left, uBb[c][i], uBa[c][i]);
      if constexpr (Second) u += half_sign * (1.0 - f) * m * donor_slope(V[c], i, left, f, 2.0);
      U[c][i] = u;
      (c < D ? d2 : carried) += (u - v) * (u - v);
    }
    if constexpr (C > D) d2 += carried;
    // K = -(1/2) d2^2 rho_L / ((1-f)(d2 rho_L + E_L/4))
    const double K = -0.5 * (d2 * d2 * rL) / ((1.0 - f) * (d2 * rL + 0.25 * sc));
    F[i] = flow;
    G[i] = H * es + flow * K;
    if constexpr (Second) cold |= static_cast<std::uint64_t>(d2 * rL > sc);
  }
  if constexpr (Second) {
    if (cold != 0) limit_cold_faces<D, C, Scaled>(row, h, axis, l);
  }
}

template <int D, int C, bool Scaled, FaceDensityLimiter Bound>
void flux_row_by_order(const Row& row, const RemapFluxHandles& h, int axis, double l,
                       const SchemeOptions& o) {
  if (!o.scheme.second_order)
    flux_row<D, C, false, false, Scaled, FaceDensityLimiter::sharp>(row, h, axis,
                                                                    l);  // has no bound
  else if (o.scheme.masked)
    flux_row<D, C, true, true, Scaled, Bound>(row, h, axis, l);
  else
    flux_row<D, C, true, false, Scaled, Bound>(row, h, axis, l);
}

}  // namespace

template <int D, int C>
void flux_row_of(const Row& row, const RemapFluxHandles& h, int axis, double l,
                 const SchemeOptions& o, RemapLaw law) {
  switch (law) {
    case RemapLaw::scaled:
      return flux_row_by_order<D, C, true, FaceDensityLimiter::sharp>(row, h, axis, l, o);
    case RemapLaw::ideal_by_energy:
      return flux_row_by_order<D, C, false, FaceDensityLimiter::as_energy>(row, h, axis, l, o);
    case RemapLaw::ideal:
      return flux_row_by_order<D, C, false, FaceDensityLimiter::sharp>(row, h, axis, l, o);
  }
}

template void flux_row_of<1, 1>(const Row&, const RemapFluxHandles&, int, double,
                                const SchemeOptions&, RemapLaw);
template void flux_row_of<1, 2>(const Row&, const RemapFluxHandles&, int, double,
                                const SchemeOptions&, RemapLaw);
template void flux_row_of<1, 3>(const Row&, const RemapFluxHandles&, int, double,
                                const SchemeOptions&, RemapLaw);
template void flux_row_of<2, 2>(const Row&, const RemapFluxHandles&, int, double,
                                const SchemeOptions&, RemapLaw);
template void flux_row_of<2, 3>(const Row&, const RemapFluxHandles&, int, double,
                                const SchemeOptions&, RemapLaw);
template void flux_row_of<3, 3>(const Row&, const RemapFluxHandles&, int, double,
                                const SchemeOptions&, RemapLaw);

void add_remap_flux(TaskList& list, const RemapFluxInput& v, const SchemeOptions& o, int effect,
                    int axis) {
  static const char* names[] = {"remap along axis 0", "remap along axis 1", "remap along axis 2"};
  const int direction = o.grid.axes.direction[axis];
  const RemapLaw law = o.materials.fluid.gamma_law() == nullptr ? RemapLaw::scaled
                       : o.scheme.density_bound == FaceDensityLimiter::as_energy
                           ? RemapLaw::ideal_by_energy
                           : RemapLaw::ideal;
  TaskBuilder task = list.task(names[axis], effect);
  RemapFluxHandles h = read_remap_inputs(task, v, o, axis);
  h.flux = task.write(v.flux[axis]);
  dispatch(o.grid.axes.count, o.grid.components, [&]<int D, int C>() {
    task.kernel([=](const Row& row) {
      const double l = row.step().dt / row.step().spacing[direction];
      flux_row_of<D, C>(row, h, axis, l, o, law);
    });
  });
}

void add_remap_fluxes(TaskList& list, const RemapFluxInput& v, const SchemeOptions& o, int effect) {
  for (int axis = 0; axis < o.grid.axes.count; ++axis) add_remap_flux(list, v, o, effect, axis);
}

}  // namespace sluice::ice
