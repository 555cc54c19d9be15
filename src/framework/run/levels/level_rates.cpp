#include "framework/run/levels/level_rates.hpp"

#include <algorithm>
#include <string>

namespace sluice {

LevelRates::LevelRates(const Scene& scene, const Component& component, Levels& levels,
                       GhostsInTime& ghosts, const ParticleCloud* particles)
    : scene_(&scene),
      component_(&component),
      levels_(&levels),
      ghosts_(&ghosts),
      particles_(particles),
      maxima_(levels.possible()) {}

// With subcycling the coarser level's limit holds for the cells that a finer level gains: their
// values lie between those of coarse cells, their steps and spacings shrink alike. In lockstep,
// with diffusion, and for a level that did not exist, rates must be measured.
void LevelRates::measure(int levels_before, double time) {
  const bool all = scene_->refinement.lock_step || component_->step().diffusive();
  const int first = all ? 0 : levels_before;
  for (int l = first; l < levels_->count(); ++l) {
    // Coefficients may depend on gradients.
    if (component_->step().diffusive()) ghosts_->fill(l, time);
    maxima_[l] = (*levels_)[l].initial_rates();
  }
  if (particles_ == nullptr || !component_->particles()->in_stages()) return;
  for (int l = 0; l < levels_->count(); ++l) {
    std::vector<double>& maxima = maxima_[l];
    const std::vector<double> own = particles_->rates(l);
    maxima.resize(std::max(maxima.size(), own.size()));
    std::copy(own.begin(), own.end(), maxima.begin());
  }
}

StepLimit LevelRates::limit() const {
  StepLimit limit;
  for (int l = 0; l < levels_->count(); ++l) {
    StepLimit own = component_->step().limit(maxima_[l]);
    own.dt *= levels_->substeps_in_coarse_step(l);
    if (levels_->count() > 1) own.reason += " on level " + std::to_string(l);
    if (l == 0 || own.dt < limit.dt) limit = own;
  }
  return limit;
}

StepLimit LevelRates::first_limit() const {
  StepLimit first = limit();
  const int finest = levels_->substeps_in_coarse_step(levels_->count() - 1);
  if (finest == 1) return first;
  first.dt /= finest;
  first.reason = "first step: one of the finest level";
  return first;
}

}  // namespace sluice
