// Step 1 over rows: the velocity.
#pragma once
#include "ice/step/variables.hpp"

namespace sluice::ice {

// u = m/rho for every component; inverse_rho: m^3/kg.
void velocity_rows(const Row& row, In momentum, Out velocity, const double* inverse_rho,
                   int components);

}  // namespace sluice::ice
