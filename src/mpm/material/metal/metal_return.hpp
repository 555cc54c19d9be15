// The return of a metal's trial deviator to its yield surface.
//
//   |S_tr| > (2/3)^(1/2) sigma_y: |S_tr| - 2 mu x - (2/3)^(1/2) sigma_y(x) = 0 for x = dgamma,
//     S = S_tr (1 - 2 mu x/|S_tr|),   eps_p += (2/3)^(1/2) x
#pragma once
#include <cmath>

#include "mpm/material/base/plastic_root.hpp"
#include "mpm/material/metal/metal_failure.hpp"

namespace sluice::mpm {

inline const double root_2_3 = std::sqrt(2.0 / 3);

// Of one particle at the start of the return.
struct TrialDeviator {
  double size = 0, mu = 0;           // |S_tr|, Pa
  double strain = 0, last_rate = 0;  // eps_p, and its rate in the last step, 1/s
  double trace_of_stress = 0;        // Pa
  double porosity = 0, dt = 0;       // 1, s
};

struct MetalReturn {
  double keep = 1;         // a factor: S = keep S_tr
  double more_strain = 0;  // d eps_p
  double yield = 0;        // sigma_y at the end, Pa
  bool soft = false;       // sigma_y <= 0
};

// `flow.stress(here, strain, rate)`: the flow stress at the state of the particle.
template <class F, class Here>
MetalReturn returned(const F& flow, const Here& here, const YieldCondition& yield,
                     const TrialDeviator& trial) {
  const double size = trial.size, mu = trial.mu, dt = trial.dt;
  const auto strength = [&](double x) {
    const double more = root_2_3 * x;
    const double f = flow.stress(here, trial.strain + more, more / dt);
    return f > 0 ? f * yield.share(f, trial.trace_of_stress, trial.porosity) : 0;
  };
  MetalReturn r;
  r.yield = strength(0);
  r.soft = !(r.yield > 0);
  const double over = size - root_2_3 * r.yield;
  if (!(over > 0)) return r;
  const auto f = [&](double x) { return size - 2 * mu * x - root_2_3 * strength(x); };
  // Where the strength does not fall the root lies before over/(2 mu), else before size/(2 mu).
  const double high = over / (2 * mu), last = trial.last_rate * dt / root_2_3;
  const double guess = last > 0 && last < high ? last : 0.9 * high, tolerance = 1e-11 * size;
  double x = secant_root(f, over, high, guess, tolerance);
  if (x < 0) x = falling_root(f, over, f(high) > 0 ? size / (2 * mu) : high, guess, tolerance);
  r.keep = 1 - 2 * mu * x / size;
  r.more_strain = root_2_3 * x;
  r.yield = r.keep * size / root_2_3;
  return r;
}

}  // namespace sluice::mpm
