// Parts of the midpoint transfer that a test can build alone.
#pragma once
#include "framework/grid/level.hpp"
#include "mpm/transfer/from_grid.hpp"

namespace sluice::mpm {

// Particles and corners go at most so far in half a step, cells: windows reach no farther.
inline constexpr double farthest_middle = 0.5;

// A spin about the axis k is one of two active directions.
inline bool turns(const Level& level, int k) {
  return level.active[static_cast<std::size_t>((k + 1) % 3)] &&
         level.active[static_cast<std::size_t>((k + 2) % 3)];
}

// About the axis k, of the velocities that were read: half their curl.
inline double spin_of(const GridAtParticles& read, int k, int q) {
  const int i = (k + 1) % 3, j = (k + 2) % 3;
  return 0.5 * (read.L[3 * j + i][q] - read.L[3 * i + j][q]);
}

// L <- L (I - dt L/2)^-1 of n particles: with it F+ = (I + dt L) F is F+ = (I - dt L/2)^-1
// (I + dt L/2) F of what was read, which turns without strain (T. J. R. Hughes, J. Winget, IJNME 15
// (1980) 1862).
void to_end_of_step(double dt, int n, GridAtParticles& read);

}  // namespace sluice::mpm
