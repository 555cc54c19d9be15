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
#include "ice/one_material/tasks.hpp"

namespace sluice::ice {

struct RemapFluxHandles {
  In rho, energy, velocity, inverse_rho, face_velocity, mask;
  In inverse_J, rho_L, energy_L, velocity_L, courant, inverse_courant, base, energy_scale;
  Out flux;
};

// The four old values of a quantity around a face, in its unit: two on either side.
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

// What the bounds of a flux's energy and density follow from.
enum class RemapLaw { ideal, ideal_by_energy, scaled };

// Compiled once, in remap_fluxes.cpp, for all that remap: these are many kernels. l: dt/dx, s/m.
template <int D, int C>
void flux_row_of(const Row& row, const RemapFluxHandles& h, int axis, double l,
                 const SchemeOptions& o, RemapLaw law);

// Everything but the flux itself.
inline RemapFluxHandles read_remap_inputs(TaskBuilder& task, const RemapFluxInput& v,
                                          const SchemeOptions& o, int axis) {
  const int direction = o.grid.axes.direction[axis];
  const Stencil both = Stencil::along(direction, 1, 0);
  const Stencil four = Stencil::along(direction, 2, 1);
  RemapFluxHandles h;
  if (o.scheme.second_order) {
    h.rho = task.read(v.rho, four);
    h.energy = task.read(v.energy, four);
    h.velocity = task.read(v.velocity, four);
  }
  if (o.scheme.masked) h.mask = task.read(v.mask, both);
  h.inverse_rho = task.read(v.inverse_rho, both);
  h.face_velocity = task.read(v.face_velocity[axis]);
  h.inverse_J = task.read(v.donors.inverse_J, both);
  h.rho_L = task.read(v.donors.rho_L, both);
  h.energy_L = task.read(v.donors.energy_L, both);
  h.velocity_L = task.read(v.donors.velocity_L, both);
  if (o.materials.mixture || o.materials.fluid.gamma_law() == nullptr)
    h.energy_scale = task.read(v.donors.energy_scale, both);
  h.courant = task.read(v.donors.courant, both);
  h.inverse_courant = task.read(v.donors.inverse_courant, both);
  if (o.scheme.second_order && o.grid.axes.count > 1) h.base = task.read(v.base[axis], both);
  return h;
}

}  // namespace sluice::ice
