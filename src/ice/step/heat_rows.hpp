// Friction and conduction in the Lagrangian phase, the same rows whether solids are near or not: no
// bit may depend on it. Work and heat are per volume of the cell, J/m^3; w: 1/mass, m^3/kg.
#pragma once
#include <array>

#include "ice/fluid/face_mean.hpp"
#include "ice/step/impulse.hpp"

namespace sluice::ice {

struct FrictionReads {
  In velocity, viscosity;  // of cells; where the viscosity varies
  std::array<In, 3> stress;
  Out impulse;
};

// Work of the viscous stress, its kinetic part taken away, per volume; w: 1/mass. Summed over
// components, then over directions: no order of the axes shows in the bits of one and two
// dimensions.
template <int D, int C, bool varies>
void viscous_work_rows(const Row& row, const FrictionReads& h, const double* __restrict w,
                       const ImpulseConstants& s, double* __restrict friction) {
  const int n = row.count();
  const double *tm[D][C], *tp[D][C], *um[D][C], *up[D][C], *u[C], *dp[C];
  for (int c = 0; c < C; ++c) {
    u[c] = row(h.velocity, c);
    dp[c] = row(h.impulse, c);
    for (int d = 0; d < D; ++d) {
      const In stress = h.stress[d];
      tm[d][c] = row(stress, c);
      tp[d][c] = row(stress, c, d, 1);
      um[d][c] = row(h.velocity, c, d, -1);
      up[d][c] = row(h.velocity, c, d, 1);
    }
  }
  const double *mu = nullptr, *mum[D], *mup[D];
  if constexpr (varies) {
    mu = row(h.viscosity);
    for (int d = 0; d < D; ++d) {
      mum[d] = row(h.viscosity, 0, d, -1);
      mup[d] = row(h.viscosity, 0, d, 1);
    }
  }
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    double work = 0;
    for (int d = 0; d < D; ++d) {
      double along = 0, carried = 0;
      for (int c = 0; c < C; ++c) {
        const double ub = u[c][i] - 0.5 * dp[c][i] * w[i];
        double above = 0.5 * (u[c][i] + up[d][c][i]), below = 0.5 * (um[d][c][i] + u[c][i]);
        if constexpr (varies) {
          above += velocity_tilt(mu[i], mup[d][i]) * (up[d][c][i] - u[c][i]);
          below += velocity_tilt(mum[d][i], mu[i]) * (u[c][i] - um[d][c][i]);
        }
        (c < D ? along : carried) += tp[d][c][i] * (above - ub) - tm[d][c][i] * (below - ub);
      }
      if constexpr (C > D) along += carried;
      work += s.l[d] * along;
    }
    friction[i] = work;
  }
}

template <int D, int C>
void friction_rows(const Row& row, const FrictionReads& h, const double* w,
                   const ImpulseConstants& s, bool tilts, double* friction) {
  if (tilts)
    viscous_work_rows<D, C, true>(row, h, w, s, friction);
  else
    viscous_work_rows<D, C, false>(row, h, w, s, friction);
}

// What heat fluxes bring, into E.
template <int D>
void conduction_rows(const Row& row, const std::array<In, 3>& heat_flux, const ImpulseConstants& s,
                     double* __restrict Es) {
  const int n = row.count();
  const double *qm[D], *qp[D];
  for (int d = 0; d < D; ++d) {
    qm[d] = row(heat_flux[d]);
    qp[d] = row(heat_flux[d], 0, d, 1);
  }
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    double heat = 0;
    for (int d = 0; d < D; ++d) heat += s.l[d] * (qm[d][i] - qp[d][i]);
    Es[i] += heat;
  }
}

}  // namespace sluice::ice
