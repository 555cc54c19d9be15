// How long the next step may be, and which bound says so.
#pragma once
#include <span>
#include <vector>

#include "framework/run/component/step_facet.hpp"
#include "ice/step/variables.hpp"

namespace sluice::ice {

// `maxima`: rates in 1/s, in the places of StepSlots.
StepLimit step_limit(const SchemeOptions& options, std::span<const double> maxima);

}  // namespace sluice::ice
