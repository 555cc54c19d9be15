// The rates on which the length of the next step rests, by level, as StepFacet::reductions()
// numbers them; in the component's units, which are 1/s of most.
#pragma once
#include <vector>

#include "framework/run/levels/ghosts_in_time.hpp"
#include "framework/run/levels/particle_cloud.hpp"

namespace sluice {

class LevelRates {
 public:
  // `particles`: null without any.
  LevelRates(const Scene& scene, const Component& component, Levels& levels, GhostsInTime& ghosts,
             const ParticleCloud* particles);

  // Maxima of the last sweep over each level; a restart sets those of its checkpoint.
  std::vector<std::vector<double>>& maxima() { return maxima_; }
  const std::vector<std::vector<double>>& maxima() const { return maxima_; }
  void set_maxima(std::vector<std::vector<double>> maxima) { maxima_ = std::move(maxima); }
  // Those of the present states, at `time`; `levels_before`: how many levels have rates already.
  void measure(int levels_before, double time);

  // The step that the physics allows next, as a step of the coarsest level.
  StepLimit limit() const;
  // Of the first step of a run: no longer than one step of the finest level. What bursts at the
  // start is faster than its state at rest tells, and refined levels follow only afterwards.
  StepLimit first_limit() const;

 private:
  const Scene* scene_;
  const Component* component_;
  Levels* levels_;
  GhostsInTime* ghosts_;
  const ParticleCloud* particles_;
  std::vector<std::vector<double>> maxima_;
};

}  // namespace sluice
