// Where a finer level begins, velocity and pressure of a face are the means of those of its fine
// faces: both levels then move the same volume, whatever each would have predicted.
//
// The means lie in work slots of the coarser level, by the cell above the face; other faces hold
// `not_given`.
#pragma once
#include "framework/run/component/step_shape.hpp"
#include "ice/step/variables.hpp"

namespace sluice::ice::pressure {

// coefficient: what stands on faces for which no finer level gives a value; unit: that of the
//   variable
constexpr double not_given = 1e300;

// Takes them from what the finer level has stored of its last sweep. Collective.
void take_finer_faces(LevelSolver& coarser, LevelSolver& finer);

}  // namespace sluice::ice::pressure
