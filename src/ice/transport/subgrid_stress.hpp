// What a turbulence model takes for the covariances of the velocity below the grid.
#pragma once
#include "ice/transport/viscosity.hpp"

namespace sluice::ice {

struct SubgridStress {
  VariableId normal;  // uu, vv, ww, m^2/s^2, by level direction
  VariableId shear;   // uv, vw, wu
};

// R_ij = -2 (mu_t/rho) (S_ij - delta_ij div u/3): the stress that the scheme takes from eddies,
// -rho R_ij, without the part of walls. The trace is no part of the model.
void add_subgrid_stress(const TransportTask& task, const StateVariables& state, VariableId eddy,
                        const SubgridStress& stress);

}  // namespace sluice::ice
