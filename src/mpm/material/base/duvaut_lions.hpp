// Rate dependence of Duvaut and Lions (Brannon 2007, Elements of phenomenological plasticity): the
// stress trails what it would be in rest, by a time tau. Pa and s.
#pragma once
#include <cmath>

#include "mpm/material/base/tensor.hpp"

namespace sluice::mpm {

// The stress at the end of a step whose rest stress (from quiet_0 to quiet) and elastic change
// are linear in time; tau >= 0:
//   sigma = quiet + (elastic - (quiet - quiet_0)) (1 - r) tau/dt + (old - quiet_0) r,
//   r = exp(-dt/tau)
inline Symmetric trailed(const Symmetric& old, const Symmetric& quiet_0, const Symmetric& quiet,
                         const Symmetric& elastic, double dt, double tau) {
  const double kept = tau > 0 ? std::exp(-dt / tau) : 0;
  const double mean = tau > 0 ? -std::expm1(-dt / tau) * tau / dt : 0;
  Symmetric sigma;
  for (std::size_t k = 0; k < 6; ++k)
    sigma[k] =
        quiet[k] + (elastic[k] - (quiet[k] - quiet_0[k])) * mean + (old[k] - quiet_0[k]) * kept;
  return sigma;
}

}  // namespace sluice::mpm
