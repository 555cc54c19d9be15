// Step 1 over rows: the velocity.
#pragma once
#include "ice/step/variables.hpp"

namespace sluice::ice {

// u = m/rho for every component.
void velocity_rows(const Row& row, In momentum, Out velocity, const double* inverse_rho,
                   int components);

}  // namespace sluice::ice
