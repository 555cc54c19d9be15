// How long the next step may be, and which bound says so.
#pragma once
#include <vector>

#include "framework/run/component/component.hpp"
#include "ice/step/variables.hpp"

namespace sluice::ice {

// `maxima`: rates in 1/s, in the places of StepSlots.
StepLimit step_limit(const SchemeOptions& options, const std::vector<double>& maxima);

}  // namespace sluice::ice
