// Tasks that say which cells ask for a finer level.
#pragma once
#include <vector>

#include "framework/run/component/component.hpp"
#include "ice/deck/ice_scene.hpp"
#include "ice/outputs/state_quantities.hpp"

namespace sluice::ice {

// refineFlag: 1 where the magnitude of the gradient of a criterion's variable exceeds its
// threshold, 0 elsewhere.
void add_refine_flag(TaskList& list, const std::vector<DiagnosticQuantity>& quantities,
                     const SchemeOptions& options,
                     const std::vector<RefinementCriterion>& criteria);

// Labels that are functions of a state, that flag and the estimates: tasks that read it as old
// state.
void declare_diagnostic_outputs(TaskList& list, const SchemeOptions& options,
                                const std::vector<RefinementCriterion>& criteria,
                                const std::vector<ErrorEstimate>& estimates);

// The label that holds the estimated error of a variable; names with a point are not for <save>.
Label estimate_label(Label variable);

// What the deck's error criteria ask for, one entry for each variable and material.
std::vector<ErrorEstimate> wanted_estimates(const std::vector<ErrorCriterion>& criteria);

// Estimated errors: the largest over the components of
//   sum over directions of |q_{i-1} - 2 q_i + q_{i+1}| / 4,
// the difference between q and its full weighting on a grid of twice the spacing.
void add_error_estimates(TaskList& list, const std::vector<DiagnosticQuantity>& quantities,
                         const SchemeOptions& options, const std::vector<ErrorEstimate>& estimates);

}  // namespace sluice::ice
