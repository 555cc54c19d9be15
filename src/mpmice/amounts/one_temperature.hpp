// Fluids of a cell at one temperature: where differences of large fluxes beside a solid have left
// one of them an energy that is none of its law's, while all together have enough.
#pragma once
#include <cmath>
#include <vector>

#include "ice/fluid/fluid.hpp"
#include "ice/fluid/material_set.hpp"

namespace sluice::mpmice {

// Solves sum_m V_m (rho e)_m(M_m/V_m, T) = sum_m E_m for T by Newton's method and sets E to it; the
// sum stays. M, V, E by material: kg, m^3, J, each per volume. False, and nothing changed: there is
// no such temperature.
inline bool take_one_temperature(const std::vector<ice::Fluid>& fluids, const double* M,
                                 const double* V, double* E) {
  constexpr int most_steps = 40;
  constexpr double round_off = 1e-13;
  const std::size_t count = fluids.size();
  double total = 0, size = 0;
  std::size_t most = 0;
  for (std::size_t m = 0; m < count; ++m) {
    total += E[m];
    size += std::fabs(E[m]);
    if (E[m] > E[most]) most = m;
  }
  if (!(M[most] > 0)) return false;
  double T = fluids[most].temperature(M[most] / V[most], E[most] / V[most]);
  double at_T[ice::max_materials] = {};
  for (int step = 0; step < most_steps && T > 0; ++step) {
    double sum = 0, capacity = 0;  // J/m^3, J/(m^3 K)
    for (std::size_t m = 0; m < count; ++m) {
      if (!(M[m] > 0)) continue;
      const double rho = M[m] / V[m], rho_e = fluids[m].energy_from_temperature(rho, T);
      at_T[m] = V[m] * rho_e;
      sum += at_T[m];
      capacity += M[m] * fluids[m].heat_capacity(rho, rho_e);
    }
    const double left = total - sum;
    if (std::fabs(left) <= round_off * size) {
      for (std::size_t m = 0; m < count; ++m) E[m] = at_T[m];
      E[most] += left;
      return true;
    }
    T += left / capacity;
  }
  return false;
}

}  // namespace sluice::mpmice
