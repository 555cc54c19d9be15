// The first step that the physics allows on one level, found without holding its state.
#pragma once
#include "framework/run/component/component.hpp"

namespace sluice {

StepLimit first_step_limit(const Component& component, const Level& level);

}  // namespace sluice
