// What the laws in rate form have in common: a start without stress, steps that turn with the
// particle or not (objective_step.hpp), and the energy as the work of the stress.
#pragma once
#include <array>
#include <cmath>

#include "mpm/material/base/batch_math.hpp"
#include "mpm/material/base/material.hpp"
#include "mpm/material/base/objective_step.hpp"

namespace sluice::mpm {

// Stress and energy are 0; moduli K and G (Pa), density (kg/m^3) of the material.
inline void start_without_stress(const Batch& b, double K, double G, double density) {
  const Nine<const double> F = b.F;
  for (int i = 0; i < b.count; ++i) {
    for (double* column : b.stress) column[i] = 0;
    b.energy[i] = 0;
    b.wave_speed[i] = std::sqrt((K + 4.0 / 3 * G) * determinant(at(F, i)) / density);
  }
}

// Without `objective`, nothing turns.
template <bool objective>
inline ObjectiveStep rate_step(const std::array<double, 9>& L, double dt) {
  return objective ? objective_step(L, dt) : plain_step(L, dt);
}
template <bool objective>
inline std::array<double, 6> half_turned(const std::array<double, 6>& stress,
                                         const ObjectiveStep& move) {
  return objective ? pushed(stress, move.half_turn) : stress;
}

// J: V_0 (sigma_n J_n + sigma_n+1 J_n+1)/2 : dt D, V_0 in m^3, both stresses turned to the middle
// of the step.
template <class T>
inline T work_of_step(const T& volume_0, const T& J_old, const std::array<T, 6>& old, const T& J,
                      const std::array<T, 6>& now, const std::array<T, 6>& strain) {
  return 0.5 * volume_0 * (J_old * double_dot(old, strain) + J * double_dot(now, strain));
}

}  // namespace sluice::mpm
