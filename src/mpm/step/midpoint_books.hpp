// The energies of velocities and spins in the midpoint transfer: for the books and the guard.
#pragma once
#include "mpm/step/chunk.hpp"

namespace sluice::mpm {

// What velocities and spins of each particle get in the kick, m dv . (v + v+)/2 +
// m (w+ - w) . I (w + w+)/2; and the energies of spins.
void book_kick(const Chunk& chunk);
// Spins are drawn to what the grid shows, of velocities that were read; the energy that this takes.
void relax_spins(const Level& level, const Chunk& chunk);

}  // namespace sluice::mpm
