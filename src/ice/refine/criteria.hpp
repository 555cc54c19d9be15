// Tasks that say which cells ask for a finer level.
#pragma once
#include <vector>

#include "ice/diagnostics.hpp"
#include "ice/ice_scene.hpp"

namespace sluice::ice {

// refineFlag: 1 where the magnitude of the gradient of a criterion's variable exceeds its
// threshold, 0 elsewhere.
void add_refine_flag(TaskList& list, const std::vector<DiagnosticQuantity>& quantities,
                     const SchemeOptions& options,
                     const std::vector<RefinementCriterion>& criteria);

}  // namespace sluice::ice
