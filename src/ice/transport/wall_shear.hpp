// Friction on walls from laws of the boundary layer.
#pragma once
#include "ice/deck/transport_settings.hpp"

namespace sluice::ice {

// Friction velocity u_tau (m/s; the stress is rho u_tau^2) from the speed along the wall (m/s) at
// a distance y (m) from it.
//
//   rough wall:   u/u_tau = ln(y/z0)/kappa
//   smooth wall:  u/u_tau = ln(y u_tau/nu)/kappa + 5.2, or y u_tau/nu where that is less: D. Coles,
//                 J. Fluid Mech. 1 (1956) 191, nu the kinematic viscosity (m^2/s)
double friction_velocity(const WallShear& model, double speed, double y, double nu);

}  // namespace sluice::ice
