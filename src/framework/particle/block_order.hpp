// Particles in the order of blocks of cells, any order inside: what gathers and scatters stream by.
#pragma once
#include <cstdint>
#include <vector>

#include "framework/grid/block_shape.hpp"
#include "framework/grid/level.hpp"
#include "framework/particle/particle_set.hpp"

namespace sluice {

// Particles begin to end - 1 lie in the cells of one block.
struct BlockRun {
  IntVec3 block;
  std::uint32_t begin = 0, end = 0;
};

// Puts the particles of a set in that order; the blocks that hold any, z slowest.
std::vector<BlockRun> sort_by_blocks(ParticleSet& set, const Level& level);

}  // namespace sluice
