// The steps of a run, and its outputs, if the step that the physics allows stayed as it is at the
// start: the deck's rules of the step and of outputs are followed step by step.
#pragma once
#include <cstdint>

#include "framework/scene/scene.hpp"

namespace sluice {

struct PlannedSteps {
  double steps = 0;
  double outputs = 0;
  double checkpoints = 0;  // that are written
  double kept = 0;         // checkpoints that are there at the end
};

// physics_dt: of the coarsest level, s. max_steps: 0: to the end of the deck.
PlannedSteps planned_steps(const Scene& scene, double physics_dt, int max_steps);

}  // namespace sluice
