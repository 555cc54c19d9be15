// What a step of solids has come to, once all ranks agree.
#pragma once
#include <span>
#include <vector>

#include "mpm/step/chunk.hpp"

namespace sluice::mpm {

struct StepOutcome {
  std::vector<double>
      rates;          // what the next step rests on: rate_count() maxima, then loads' counts
  double travel = 0;  // farthest way of a particle, cells
  bool left = false;  // the domain

  // Velocities were changed further: bounds of those of a body, all ranks'.
  void include_velocities(int body, Vec3 up, Vec3 down);
};

// The books of the run take the sums of all bodies. `prescribed`: the deformation is; what it
// changes of energy is then work from outside, done against the stress.
void book_bodies(bool prescribed, bool midpoint, NodeBooks& books);

// Maxima, sums and faults of all ranks; `counts` of loads are kept with the maxima. Collective.
Verdict conclude_step(const StageScope& scope, std::span<const double> counts, StepReport& all,
                      const NodeBooks& books, StepOutcome& outcome);

}  // namespace sluice::mpm
