// What the pressure solves of the last step took, for the histories of a run.
#pragma once
#include <optional>

#include "framework/field/label.hpp"

namespace sluice::ice::pressure {

struct SolveHistory {
  int passes = 0;           // of the attempt that was taken
  int iterations = 0;       // of the linear solver, in all of them
  double residual = 0;      // of the last linear solve, over its right-hand side: a ratio
  double volume_error = 0;  // the largest relative one after the last pass

  // The value of a history of this name, a count or one of these ratios; none of another.
  std::optional<double> value(Label label) const;
};

}  // namespace sluice::ice::pressure
