// Tasks that say which cells ask for a finer level.
#pragma once
#include <vector>

#include "framework/run/component.hpp"
#include "ice/deck/ice_scene.hpp"
#include "ice/saved/state_quantities.hpp"

namespace sluice::ice {

// refineFlag: 1 where the magnitude of the gradient of a criterion's variable exceeds its
// threshold, 0 elsewhere.
void add_refine_flag(TaskList& list, const std::vector<DiagnosticQuantity>& quantities,
                     const SchemeOptions& options,
                     const std::vector<RefinementCriterion>& criteria);

// The label that holds the estimated error of a variable; names with a point are not for <save>.
Label estimate_label(Label variable);

// What the deck's error criteria ask for, one entry for each variable and material.
std::vector<ErrorEstimate> wanted_estimates(const std::vector<ErrorCriterion>& criteria);

// Estimated errors: the largest over the components of
//   sum over directions of |q_{i-1} - 2 q_i + q_{i+1}| / 4,
// the difference between q and its full weighting on a grid of twice the spacing.
void add_error_estimates(TaskList& list, const std::vector<DiagnosticQuantity>& quantities,
                         const SchemeOptions& options, const std::vector<ErrorEstimate>& estimates);

// Cells that interfaces between materials pass, one entry for each criterion that asks for a level
// finer than that of the state; ghost cells are filled.
std::vector<FlagSeeds> interface_seeds(const Warehouse& state, int materials,
                                       const std::vector<InterfaceCriterion>& criteria);

}  // namespace sluice::ice
