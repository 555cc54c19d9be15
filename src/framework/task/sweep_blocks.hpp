// How the local boxes of a level are cut into blocks for a sweep.
#pragma once
#include <cstdint>
#include <vector>

#include "framework/grid/level.hpp"

namespace sluice {

struct Block {
  int box = 0;  // local box number
  IndexBox cells;
  bool may_be_skipped = true;
  int kind = 0;  // of the graph that it runs
};

// Cuts the local boxes of a level into blocks no larger than `extents`, as a BlockLattice does.
std::vector<Block> place_blocks(const std::vector<GridBox>& boxes, IntVec3 extents);
// Where few cells need a costlier graph than the others (cells that solids cut), small blocks
// confine them; alike cells are swept fastest in large ones.
enum class BlockSize { large, small };
// The extents that were measured best for a level.
IntVec3 default_block(const Level& level, BlockSize size = BlockSize::large);
// Cut once more along the second active direction (the only one in 1-D), so that every thread gets
// as many blocks.
IntVec3 balanced_block_extents(IntVec3 extents, const Level& level,
                               const std::vector<GridBox>& boxes, int threads);

// Blocks that follow each other along the last active direction (of two or three) and share cells
// across, in order, by number: each block is in one stack. A stack holds `max_cells` or less (a
// block that has more is one), and are not much wider than their widest block.
std::vector<std::vector<std::size_t>> stack_blocks(const std::vector<Block>& blocks,
                                                   const Level& level, std::int64_t max_cells);

}  // namespace sluice
