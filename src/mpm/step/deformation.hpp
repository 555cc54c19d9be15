// The deformation gradient after a step: F <- (I + dt L) F by default (mpm_scheme, section 8).
#pragma once
#include "mpm/material/base/material.hpp"

namespace sluice::mpm {

// From batch.old_F and batch.L into the columns of batch.F and volume = det F V_0. `order`: 1 first
// order; s > 1 at least s equal substeps of first order, more where |L| dt is large; s < 1: the
// exponential series to order |s|. The first particle whose F is turned inside out; -1: none.
int deform(int order, double dt, const Batch& batch, double* volume);

}  // namespace sluice::mpm
