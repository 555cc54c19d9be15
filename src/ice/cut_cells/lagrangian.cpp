// Step 6 where solids are, per volume of the cell (l = dt/dx, alpha = 1 - a at the start):
//
//   V_L  = V' + sum_d l_d (w+ - w-)
//   dP_d = l_d [alpha+ p+ - alpha- p- - p_w (alpha+ - alpha-)] - dt V (rho g + f) - friction
//   u_L  = u - dP/M,  ub = u - dP/(2M)                                          (M = V rho)
//   E_L  = V E - sum_d l_d [p+ (w+ - alpha+ ub) - p- (w- - alpha- ub)]
//          + p_w [(V - V') - sum_d l_d (alpha+ - alpha-) ub_d] + friction, conduction
// The wall pressure p_w acts on the surface in the cell, which closes its open faces. A cell
// without fluid has neither M nor ub. With V = V' = 1 and open faces all is as in
// one_material/lagrangian.cpp, to the bit.
//
// What donors give to the remap: rho V/V_L, E_L/V_L, u_L; but the old rho, E and u, without
// slopes, where little fluid is left of the cell, or its volume changes much, or E_L is spent: what
// happens in such a cell in one step says nothing about what passes its faces.
#include "framework/base/infinity.hpp"
#include "ice/cut_cells/variables.hpp"
#include "ice/fluid/closure_rows.hpp"
#include "ice/fluid/limiters.hpp"
#include "ice/step/heat_rows.hpp"
#include "ice/step/held_faces.hpp"
#include "ice/step/remap_bounds.hpp"
#include "ice/step/shock_shear.hpp"
#include "ice/step/walled_donors.hpp"

namespace sluice::ice::cut_cells {
namespace {

// coefficient: inverse of the mass of a cell without fluid: any impulse there shows; unit: m^3/kg
constexpr double without_mass = 1e300;

struct Handles {
  In rho, inverse_rho, velocity, sound, momentum, energy, fraction, next, wall_pressure, open;
  std::array<In, 3> face_pressure, flow, covered, stress, heat_flux;
  Out inverse_J, rho_L, energy_L, velocity_L, energy_star, courant, inverse_courant, scale;
  Out mixture;  // work of pressures, of friction
  Out impulse, mass, cell_momentum, inverse_mass, donor_velocity, base_mask;
  std::array<Out, 3> remap_mask;
  Out gives_old;
  FrictionReads friction;
  ShockShearReads shear;
};

// Rows along every axis, low and high faces.
template <int D>
struct FaceRows {
  const double *pm[D], *pp[D], *wm[D], *wp[D], *am[D], *ap[D];

  FaceRows(const Row& row, const Handles& h) {
    for (int d = 0; d < D; ++d) {
      pm[d] = row(h.face_pressure[d]);
      pp[d] = row(h.face_pressure[d], 0, d, 1);
      wm[d] = row(h.flow[d]);
      wp[d] = row(h.flow[d], 0, d, 1);
      am[d] = row(h.covered[d]);
      ap[d] = row(h.covered[d], 0, d, 1);
    }
  }
};

// Which cells of a row lie on a side of the domain, where it does not repeat.
struct Sides {
  bool all = false;
  int first = -1, last = -1;

  Sides(const Row& row, const SchemeOptions& o) {
    const IntVec3 cell = row.cell();
    for (int a = 1; a < o.grid.axes.count; ++a) {
      const int d = o.grid.axes.direction[a];
      if (o.grid.periodic[d]) continue;
      all |= cell[d] == o.grid.domain.lower[d] || cell[d] == o.grid.domain.upper[d] - 1;
    }
    const int d = o.grid.axes.direction[0];
    if (o.grid.periodic[d]) return;
    first = o.grid.domain.lower[d] - cell[d];
    last = o.grid.domain.upper[d] - 1 - cell[d];
  }
  bool meets(int i) const { return all | (i == first) | (i == last); }
};

// What viscous stress takes of dP, one component.
template <int D>
void pull_row(const Row& row, const Handles& h, const ImpulseConstants& s, int c,
              double* __restrict dP) {
  const int n = row.whole_vectors();
  const double *tm[D], *tp[D];
  for (int d = 0; d < D; ++d) {
    const In t = h.stress[d];
    tm[d] = row(t, c);
    tp[d] = row(t, c, d, 1);
  }
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    double pull = 0;
    for (int d = 0; d < D; ++d) pull += s.l[d] * (tp[d][i] - tm[d][i]);
    dP[i] -= pull;
  }
}

// dP of the cell, by component; M, P.
template <int D, int C>
void impulse_rows(const Row& row, const Handles& h, const ImpulseConstants& s,
                  const SchemeOptions& o) {
  const int n = row.whole_vectors();
  const FaceRows<D> f(row, h);
  const double *r = row(h.rho), *theta = row(h.fraction), *pw = row(h.wall_pressure);
  double* __restrict M = row(h.mass);
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) M[i] = r[i] * (1.0 - theta[i]);
  for (int c = 0; c < C; ++c) {
    const double* m = row(h.momentum, c);
    double* __restrict dP = row(h.impulse, c);
    double* __restrict P = row(h.cell_momentum, c);
    const double kick = s.kick[c], push = s.push[c], l = s.l[c];
#pragma GCC ivdep
    for (int i = 0; i < n; ++i) {
      const double V = 1.0 - theta[i];
      P[i] = m[i] * V;
      dP[i] = -(kick * M[i] + push * V);
    }
    if (c < D) {
      const double *am = f.am[c % D], *ap = f.ap[c % D], *pm = f.pm[c % D], *pp = f.pp[c % D];
#pragma GCC ivdep
      for (int i = 0; i < n; ++i) {
        const double low = 1.0 - am[i], high = 1.0 - ap[i];
        dP[i] = l * ((high * pp[i] - low * pm[i]) - pw[i] * (high - low)) + dP[i];
      }
    }
    if (o.transport.viscous) pull_row<D>(row, h, s, c, dP);
  }
}

// Heat of friction and conduction. E_L, which is written behind it, holds what friction gives.
template <int D, int C>
void add_heat(const Row& row, const Handles& h, const ImpulseConstants& s, const SchemeOptions& o,
              double* energy) {
  if (o.transport.viscous) {
    const int n = row.count();
    double* friction = o.materials.mixture ? row(h.mixture, 1) : row(h.energy_L);
    friction_rows<D, C>(row, h.friction, row(h.inverse_mass), s, o.friction_tilts(), friction);
    for (int i = 0; i < n; ++i) energy[i] += friction[i];
  }
  if (o.transport.conducting) conduction_rows<D>(row, h.heat_flux, s, energy);
}

// 1/M, and E* of the cell: what the pressures on its faces and on the wall work, and heat.
template <int D, int C>
void energy_rows(const Row& row, const Handles& h, const ImpulseConstants& s,
                 const SchemeOptions& o, const FaceRows<D>& f, bool sheared) {
  const int n = row.whole_vectors();
  const double *w = row(h.inverse_rho), *E = row(h.energy);
  const double *theta = row(h.fraction), *after = row(h.next), *pw = row(h.wall_pressure);
  const double *u[D], *dP[D];
  for (int d = 0; d < D; ++d) {
    u[d] = row(h.velocity, d);
    dP[d] = row(h.impulse, d);
  }
  double* __restrict W = row(h.inverse_mass);
  double* __restrict Es = row(h.energy_star);
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    const double V = 1.0 - theta[i];
    const double inverse_M = V > 0 ? w[i] / V : without_mass;
    W[i] = inverse_M;
    double work = 0, closing = 0;
    for (int d = 0; d < D; ++d) {
      const double ub_wet = u[d][i] - 0.5 * dP[d][i] * inverse_M, ub = V > 0 ? ub_wet : 0.0;
      const double low = 1.0 - f.am[d][i], high = 1.0 - f.ap[d][i];
      work +=
          s.l[d] * (f.pp[d][i] * (f.wp[d][i] - high * ub) - f.pm[d][i] * (f.wm[d][i] - low * ub));
      closing += s.l[d] * (high - low) * ub;
    }
    Es[i] = V * E[i] - (work - pw[i] * ((after[i] - theta[i]) - closing));
  }
  if (sheared)
    for_each_sheared_part<D>(row, h.shear, [&](const Row& part) {
      add_heat_of_shear<D, C>(part, h.shear, part(h.inverse_mass), part(h.energy_star));
    });
  if (o.keeps_work()) {
    double* __restrict work = row(h.mixture, 0);
#pragma GCC ivdep
    for (int i = 0; i < n; ++i) work[i] = (1.0 - theta[i]) * E[i] - Es[i];
  }
  add_heat<D, C>(row, h, s, o, Es);
}

// The Lagrangian state of the cell: 1/J, rho_L, E_L, outflow, velocities; which donors give their
// old state.
template <int D, int C>
void lagrangian_rows(const Row& row, const Handles& h, const ImpulseConstants& s,
                     const SchemeOptions& o, const FaceRows<D>& f) {
  const int n = row.whole_vectors();
  const double *r = row(h.rho), *E = row(h.energy), *theta = row(h.fraction), *after = row(h.next);
  const double *W = row(h.inverse_mass), *Es = row(h.energy_star);
  const double *u[C], *dP[C];
  double *v[C], *given[C];
  for (int c = 0; c < C; ++c) {
    u[c] = row(h.velocity, c);
    dP[c] = row(h.impulse, c);
    v[c] = row(h.velocity_L, c);
    given[c] = row(h.donor_velocity, c);
  }
  double* __restrict iJ = row(h.inverse_J);
  double* __restrict rL = row(h.rho_L);
  double* __restrict EL = row(h.energy_L);
  double* __restrict N = row(h.courant);
  double* __restrict iN = row(h.inverse_courant);
  double* __restrict whole = row(h.base_mask);
  double* __restrict keeps = row(h.gives_old);
  const Sides sides(row, o);
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    const double V = 1.0 - theta[i];
    double stretch = 0, out = 0;
    for (int d = 0; d < D; ++d) {
      stretch += s.l[d] * (f.wp[d][i] - f.wm[d][i]);
      out += s.l[d] * (larger(0.0, f.wp[d][i]) + larger(0.0, -f.wm[d][i]));
    }
    double carried = 0;
    for (int c = D; c < C; ++c) carried += s.l[c] * std::fabs(u[c][i]);
    if constexpr (C > D) out += V * carried;
    const double volume = (1.0 - after[i]) + stretch;
    const bool solid = (theta[i] > 0) | (after[i] > 0);
    const bool old = solid & !gives_new_state(V, volume, Es[i], out, sides.meets(i));
    const double room = larger(volume, min_fluid_volume), inverse = 1.0 / (solid ? room : volume);
    const double rho_after = (r[i] * V) * inverse, E_after = Es[i] * inverse;
    const double outflow = smaller(out * inverse, 1.0);
    iJ[i] = inverse;
    rL[i] = old ? r[i] : rho_after;
    EL[i] = old ? E[i] : E_after;
    N[i] = outflow;
    iN[i] = 1.0 / larger(outflow, min_outflow);
    whole[i] = old ? 0.0 : V;
    keeps[i] = old ? 1.0 : 0.0;
    for (int c = 0; c < C; ++c) {
      const double wet = u[c][i] - dP[c][i] * W[i], after_push = V > 0 ? wet : 0.0;
      v[c][i] = after_push;
      given[c][i] = old ? u[c][i] : after_push;
    }
  }
}

// Where slopes count: along each axis, and at all.
template <int D>
void mask_rows(const Row& row, const Handles& h) {
  const int n = row.whole_vectors();
  double* __restrict whole = row(h.base_mask);
  for (int d = 0; d < D; ++d) {
    const double* open = row(h.open, d);
    double* __restrict mask = row(h.remap_mask[d]);
#pragma GCC ivdep
    for (int i = 0; i < n; ++i) mask[i] = whole[i] * open[i];
  }
  for (int d = 0; d < D; ++d) {
    const double* open = row(h.open, d);
#pragma GCC ivdep
    for (int i = 0; i < n; ++i) whole[i] *= open[i];
  }
}

template <int D, int C>
void cell_rows(const Row& row, const Handles& h, const ImpulseConstants& s,
               const SchemeOptions& o) {
  impulse_rows<D, C>(row, h, s, o);
  const bool sheared = o.scheme.shears_shocks && is_sheared<D>(row, h.shear);
  if (sheared) take_shear<D, C>(row, h.shear);
  leave_prescribed_ghosts(row, o, h.velocity, h.sound, h.impulse);
  const FaceRows<D> f(row, h);
  energy_rows<D, C>(row, h, s, o, f, sheared);
  lagrangian_rows<D, C>(row, h, s, o, f);
  mask_rows<D>(row, h);
}

}  // namespace

void add_lagrangian(TaskList& list, const LagrangianInput& v, const SchemeOptions& o, int effect) {
  TaskBuilder task = list.task("Lagrangian phase with solids", effect);
  Handles h;
  h.rho = task.read(v.fluid.rho);
  h.inverse_rho = task.read(v.fluid.inverse_rho);
  h.velocity =
      task.read(v.fluid.velocity, o.transport.viscous ? Stencil::box(1) : Stencil::point());
  if (holds_velocities(o)) h.sound = task.read(v.fluid.sound);
  h.momentum = task.read(v.momentum);
  h.energy = task.read(v.fluid.energy);
  h.fraction = task.read(v.fraction);
  h.next = task.read(v.next);
  h.wall_pressure = task.read(v.wall_pressure);
  h.open = task.read(v.open);
  for (int axis = 0; axis < o.grid.axes.count; ++axis) {
    const Stencil both = Stencil::along(o.grid.axes.direction[axis], 0, 1);
    h.face_pressure[axis] = task.read(v.fluid.faces.pressure[axis], both);
    h.flow[axis] = task.read(v.flow[axis], both);
    h.covered[axis] = task.read(v.covered[axis], both);
    if (o.transport.viscous) h.stress[axis] = task.read(v.fluid.faces.stress[axis], both);
    if (o.transport.conducting) h.heat_flux[axis] = task.read(v.fluid.faces.heat_flux[axis], both);
    h.remap_mask[axis] = task.write(v.cell.remap_mask[axis]);
  }
  h.inverse_J = task.write(v.fluid.donors.inverse_J);
  h.rho_L = task.write(v.fluid.donors.rho_L);
  h.energy_L = task.write(v.fluid.donors.energy_L);
  h.velocity_L = task.write(v.fluid.donors.velocity_L);
  h.energy_star = task.write(v.fluid.energy_star);
  h.courant = task.write(v.fluid.donors.courant);
  h.inverse_courant = task.write(v.fluid.donors.inverse_courant);
  h.impulse = task.write(v.fluid.impulse);
  if (o.friction_tilts())
    h.friction.viscosity = task.read(v.fluid.front_viscosity, Stencil::box(1));
  h.friction.velocity = h.velocity;
  h.friction.stress = h.stress;
  h.friction.impulse = h.impulse;
  if (o.scheme.shears_shocks) h.shear = read_shock_shear(task, v.fluid.shear);
  h.shear.impulse = h.impulse;
  h.mass = task.write(v.cell.mass);
  h.cell_momentum = task.write(v.cell.momentum);
  h.inverse_mass = task.write(v.cell.inverse_mass);
  h.donor_velocity = task.write(v.cell.donor_velocity);
  h.base_mask = task.write(v.cell.base_mask);
  h.gives_old = task.write(v.cell.gives_old);
  if (o.keeps_work()) h.mixture = task.write(v.fluid.lagrangian_mixture);
  const bool scaled = !o.materials.mixture && o.materials.fluid.gamma_law() == nullptr;
  if (scaled) h.scale = task.write(v.fluid.donors.energy_scale);
  dispatch(o.grid.axes.count, o.grid.components, [&]<int D, int C>() {
    task.kernel([=](const Row& row) {
      cell_rows<D, C>(row, h, impulse_constants(o, row.step()), o);
      if (scaled)
        energy_scale_row(o.materials.fluid, row.count(), row(h.rho_L), row(h.energy_L),
                         row(h.scale));
    });
  });
}

}  // namespace sluice::ice::cut_cells
