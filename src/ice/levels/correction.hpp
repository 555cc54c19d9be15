// One cell of one gas before and after a difference of fluxes.
//
//   rho' = rho + drho,  m' = m + dm,  E' = E + dE_tot - v.dm + |v|^2 drho/2 - rho' |dv|^2/2
// with v = m/rho and dv = (dm - v drho)/rho': total energy in the frame of the cell, so that no
// kinetic energy is subtracted.
#pragma once
#include <cmath>
#include <limits>

#include "ice/fluid/fluid.hpp"

namespace sluice::ice {

// threshold: smallest share of its density, and of the internal energy of a gas, that a flux
//   correction leaves to a cell; unit: 1; test: Correction.GivesEachCellTheShareThatItCanBear
constexpr double min_kept_by_corrections = 0.1;
// coefficient: the shares of a correction that are tried, one after the other; unit: 1
constexpr double correction_shares[] = {1.0, 0.5, 0.25, 0.125};

struct GasCell {
  double rho, m[3], E;  // kg/m^3; momentum by component, kg/(m^2 s); energy, J/m^3
};

// Change of |m|^2/(2 rho) when share * change is added, J/m^3.
inline double kinetic_change(const GasCell& s, const GasCell& change, double share,
                             int components) {
  const double drho = share * change.rho;
  double square = 0, along = 0, lag = 0;
  for (int c = 0; c < components; ++c) {
    const double v = s.m[c] / s.rho, dm = share * change.m[c];
    const double shift = dm - v * drho;
    square += v * v;
    along += v * dm;
    lag += shift * shift;
  }
  return 0.5 * lag / (s.rho + drho) - (0.5 * square * drho - along);
}

// May a cell become so: a state of its law that has kept a tenth of its density and, of an ideal
// gas, of its internal energy.
inline bool bearable(const Fluid& fluid, const GasCell& before, const GasCell& after) {
  constexpr double most = std::numeric_limits<double>::max();
  if (!(after.rho >= min_kept_by_corrections * before.rho && after.rho <= most)) return false;
  if (fluid.gamma_law() != nullptr)
    return after.E >= min_kept_by_corrections * before.E && after.E <= most;
  return std::fabs(after.E) <= most && fluid.admissible(after.rho, after.E);
}

// Adds the largest share that the cell can bear and returns it. `internal`: the change of energy is
// that of internal energy.
inline double correct_gas(GasCell& s, const GasCell& change, int components, bool internal,
                          const Fluid& fluid) {
  for (const double share : correction_shares) {
    GasCell n = s;
    n.rho += share * change.rho;
    for (int c = 0; c < components; ++c) n.m[c] += share * change.m[c];
    n.E += share * change.E;
    if (!internal) n.E -= kinetic_change(s, change, share, components);
    if (!bearable(fluid, s, n)) continue;
    s = n;
    return share;
  }
  return 0.0;
}

}  // namespace sluice::ice
