// What pressure, gravity, a driving force and viscous stress take from the momentum of a cell in a
// step.
//
//   dp_c = l_c (p_f+ - p_f-) - dt (g_c rho + f_c) - sum_d l_d (t_f+ - t_f-)_c,   l_d = dt/dx_d
#pragma once
#include <array>

#include "ice/step/variables.hpp"

namespace sluice::ice {

struct ImpulseHandles {
  In rho;
  std::array<In, 3> face_pressure, stress;  // by axis; stress only when viscous
  Out impulse;
};

struct ImpulseConstants {
  double l[3] = {0, 0, 0};     // dt/dx by component, s/m; the first are the axes
  double kick[3] = {0, 0, 0};  // dt g by component, m/s
  double push[3] = {0, 0, 0};  // dt f by component, kg/(m^2 s)
};

inline ImpulseConstants impulse_constants(const SchemeOptions& o, const StepConstants& step) {
  ImpulseConstants s;
  for (int c = 0; c < o.grid.components; ++c) {
    s.l[c] = step.dt / step.spacing[o.grid.direction[c]];
    s.kick[c] = step.dt * o.forces.gravity[o.grid.direction[c]];
    s.push[c] = step.dt * o.forces.driving[o.grid.direction[c]];
  }
  return s;
}

// Takes the stress from the impulse of component c.
template <int D>
void add_pull(const Row& row, const ImpulseHandles& h, const ImpulseConstants& s, int c) {
  const int n = row.whole_vectors();
  const double *tm[D], *tp[D];
  for (int d = 0; d < D; ++d) {
    tm[d] = row(h.stress[d], c);
    tp[d] = row(h.stress[d], c, d, 1);
  }
  double* __restrict dp = row(h.impulse, c);
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    double pull = 0;  // of all directions first: the order of two does not show in the bits
    for (int d = 0; d < D; ++d) pull += s.l[d] * (tp[d][i] - tm[d][i]);
    dp[i] -= pull;
  }
}

template <int D, int C>
void impulse_rows(const Row& row, const ImpulseHandles& h, const ImpulseConstants& constants,
                  bool viscous) {
  const int n = row.whole_vectors();
  const ImpulseConstants s = constants;
  const double* __restrict r = row(h.rho);
  const double *pm[D], *pp[D];
  double* dp[C];
  for (int d = 0; d < D; ++d) {
    pm[d] = row(h.face_pressure[d]);
    pp[d] = row(h.face_pressure[d], 0, d, 1);
  }
  for (int c = 0; c < C; ++c) dp[c] = row(h.impulse, c);
#pragma GCC ivdep
  for (int i = 0; i < n; ++i)
    for (int c = 0; c < C; ++c) {
      const double weight = s.kick[c] * r[i] + s.push[c];
      dp[c][i] = c < D ? s.l[c] * (pp[c % D][i] - pm[c % D][i]) - weight : -weight;
    }
  if (!viscous) return;
  for (int c = 0; c < C; ++c) add_pull<D>(row, h, s, c);
}

}  // namespace sluice::ice
