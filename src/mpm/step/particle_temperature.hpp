// Temperatures of particles after a step: what the law gives, and the rate of all changes.
#pragma once
#include "mpm/step/solid_effect.hpp"

namespace sluice::mpm {

// T <- T + dt q, q: heating by the law and the artificial viscosity. In every scene, before what
// else changes temperatures.
class HeatOfLaw final : public SolidEffect {
 public:
  void to_particles(const Chunk& chunk) override;
};

// dT/dt of the step, where it is saved: behind all that changes temperatures.
class SavedHeating final : public SolidEffect {
 public:
  static bool possible(const std::vector<Carried>& carried);
  void to_particles(const Chunk& chunk) override;
};

}  // namespace sluice::mpm
