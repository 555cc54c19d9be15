// Parts of the midpoint transfer that a test can build alone.
#pragma once
#include "mpm/transfer/from_grid.hpp"

namespace sluice::mpm {

// Particles and corners go at most so far in half a step, cells: windows reach no farther.
inline constexpr double farthest_middle = 0.5;

// L <- L (I - dt L/2)^-1 of n particles: with it F+ = (I + dt L) F is F+ = (I - dt L/2)^-1
// (I + dt L/2) F of what was read, which turns without strain (T. J. R. Hughes, J. Winget, IJNME 15
// (1980) 1862).
void to_end_of_step(double dt, int n, GridAtParticles& read);

}  // namespace sluice::mpm
