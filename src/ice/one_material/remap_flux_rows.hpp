// Step 8: remap through each face from the upwind cell.
//
//   H = l u_f, nu = |H|/J, s = sign(H), N outflow Courant number, N_ = max(N,.05), B = 2/N_
//   rho_s = base + s (1-nu)/2 Q3(D rho; nu, B)/J, .1 rho_L <= rho_s <= rho_L (.95+.05 N)/N_
//   e_s   = base + s (1-nu)/2 Q3(D E;   nu, 2)/J, .1 E_L   <= e_s   <= E_L   (.75+.25 N)/N_
//   F = H rho_s,  f = min(|F|/rho, .99),  U = base + s (1-f)/2 Q3(D u; f, 2)
//   d2 = |U - v|^2,  K = -(1/2) d2/(1-f) d2/(d2 + .25 E_L/rho_L),  G = H e_s + F K
// (laws other than ideal gases: E_L - .9 S <= e_s <= E_L + S ((.75+.25 N)/N_ - 1) with the energy
// scale S = (p_L + pi)/G in place of E_L, also in K)
// with differences D of the old state, v the donor's Lagrangian velocity. Only the density has the
// sharp bound 2/N: it keeps contacts in slow flow two to three cells wide, while a sharp bound on
// energy or velocity would empty cold cells of energy. K, the correction of the kinetic-energy
// flux, vanishes unless the jump is hypersonic in the donor.
#pragma once
#include "ice/fluid/limiters.hpp"
#include "ice/step/variables.hpp"

namespace sluice::ice {

struct RemapFluxHandles {
  In rho, energy, velocity, inverse_rho, face_velocity, mask;
  In inverse_J, rho_L, energy_L, velocity_L, courant, inverse_courant, base, energy_scale;
  Out flux;
};

// The four old values around a face: two on either side.
struct Around {
  const double *mm, *m, *p, *pp;
  Around from(int first) const { return {mm + first, m + first, p + first, pp + first}; }
};

inline Around around(const Row& row, In in, int component, int axis) {
  return {row(in, component, axis, -2), row(in, component, axis, -1), row(in, component),
          row(in, component, axis, 1)};
}

// Both are loaded: one load after the other, or a masked one, costs more than the choice.
[[gnu::always_inline]] inline double chosen(bool left, double right_cell, double left_cell) {
  return left ? right_cell : left_cell;
}

// Q3 of the donor: the right cell when the flow is to the left.
inline double donor_slope(const Around& q, int i, bool left, double nu, double B) {
  const double middle = q.p[i] - q.m[i];
  const double low = q.m[i] - q.mm[i], high = q.pp[i] - q.p[i];
  return upwind_slope(chosen(left, high, low), middle, nu, B);
}

// The bound is known when the loop is compiled: a choice in it costs its vectors or its registers;
// so would a call.
template <int D, int C, bool Second, bool Masked, bool Scaled, DensityBound Bound>
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
      rs += weight * donor_slope(R, i, left, nu, Bound == DensityBound::sharp ? 2.0 * iN : 2.0);
      es += weight * donor_slope(E, i, left, nu, 2.0);
      rs = smaller(larger(rs, 0.1 * rL), rL * (0.95 + 0.05 * N) * iN);
      if constexpr (Scaled)
        es = smaller(larger(es, EL - 0.9 * sc), EL + sc * ((0.75 + 0.25 * N) * iN - 1.0));
      else
        es = smaller(larger(es, 0.1 * EL), EL * (0.75 + 0.25 * N) * iN);
    }
    const double flow = H * rs;
    const double f = smaller(std::fabs(flow) * chosen(left, wb[i], wa[i]), 0.99);
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
  }
}

template <int D, int C, bool Scaled, DensityBound Bound = DensityBound::sharp>
void flux_row_of(const Row& row, const RemapFluxHandles& h, int axis, double l,
                 const SchemeOptions& o) {
  if (!o.second_order)
    flux_row<D, C, false, false, Scaled, Bound>(row, h, axis, l);
  else if (o.masked)
    flux_row<D, C, true, true, Scaled, Bound>(row, h, axis, l);
  else
    flux_row<D, C, true, false, Scaled, Bound>(row, h, axis, l);
}

// Everything but the flux itself.
inline RemapFluxHandles read_remap_inputs(TaskBuilder& task, const SchemeVariables& v,
                                          const SchemeOptions& o, int axis) {
  const int direction = o.axes.direction[axis];
  const Stencil both = Stencil::along(direction, 1, 0);
  const Stencil four = Stencil::along(direction, 2, 1);
  const auto face = static_cast<std::size_t>(axis);
  RemapFluxHandles h;
  if (o.second_order) {
    h.rho = task.read(v.rho, four);
    h.energy = task.read(v.energy, four);
    h.velocity = task.read(v.velocity, four);
  }
  if (o.masked) h.mask = task.read(v.mask, both);
  h.inverse_rho = task.read(v.inverse_rho, both);
  h.face_velocity = task.read(v.face_velocity[face]);
  h.inverse_J = task.read(v.inverse_J, both);
  h.rho_L = task.read(v.rho_L, both);
  h.energy_L = task.read(v.energy_L, both);
  h.velocity_L = task.read(v.velocity_L, both);
  if (o.mixture || o.fluid.ideal() == nullptr) h.energy_scale = task.read(v.energy_scale, both);
  h.courant = task.read(v.courant, both);
  h.inverse_courant = task.read(v.inverse_courant, both);
  if (o.second_order && o.axes.count > 1) h.base = task.read(v.base[face], both);
  return h;
}

}  // namespace sluice::ice
