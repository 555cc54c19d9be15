// Fourier's law on faces: between two cells, and to a wall.
#pragma once
#include "ice/boundary/region_rules.hpp"
#include "ice/fluid/face_mean.hpp"

namespace sluice::ice {

// q = k (T_a - T_b)/dx, a on the low side: W/m^2 from W/(m K), K and m.
inline void heat_flux_row(int n, double k, const double* __restrict Ta, const double* __restrict Tb,
                          double inverse_dx, double* __restrict q) {
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) q[i] = k * ((Ta[i] - Tb[i]) * inverse_dx);
}

// The same where the conductivity varies: the harmonic mean.
inline void heat_flux_row(int n, const double* __restrict ka, const double* __restrict kb,
                          const double* __restrict Ta, const double* __restrict Tb,
                          double inverse_dx, double* __restrict q) {
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) q[i] = harmonic_mean(ka[i], kb[i]) * ((Ta[i] - Tb[i]) * inverse_dx);
}

// What leaves a cell at temperature T: the wall's temperature is half a cell away, a given gradient
// (along the inward normal) is taken as it is. W/m^2.
inline double heat_to_wall(const WallHeat& wall, double k, double T, double dx, double inverse_dx) {
  // Over the wall outward, as if the next cell lay a whole cell away.
  const double rise = wall.fixed ? 2.0 * (wall.temperature - T) : -wall.gradient * dx;
  return k * (-rise * inverse_dx);
}

}  // namespace sluice::ice
