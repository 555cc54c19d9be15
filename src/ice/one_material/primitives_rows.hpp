// Step 1 over rows: 1/rho, pressure and sound speed of one material; velocity.
#pragma once
#include "ice/step/variables.hpp"

namespace sluice::ice {

// From density (kg/m^3) and internal energy per volume (J/m^3).
void primitive_row(const Fluid& fluid, int n, const double* rho, const double* energy,
                   double* inverse_rho, double* pressure, double* sound);

// u = m/rho for every component.
void velocity_rows(const Row& row, In momentum, Out velocity, const double* inverse_rho,
                   int components);

}  // namespace sluice::ice
