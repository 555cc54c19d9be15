// Extents of blocks, and cutting.
#include "framework/task/sweep_blocks.hpp"

#include <algorithm>

namespace sluice {

IntVec3 default_block(const Level& level) {
  // Measured best: long rows, and as few recomputed ghosts as the cache allows. By active axes.
  constexpr int extents[3][3] = {{512, 1, 1}, {256, 64, 1}, {128, 48, 128}};
  IntVec3 b = level.domain.size();
  int axis = 0;
  for (int d = 0; d < 3; ++d)
    if (level.active[static_cast<std::size_t>(d)])
      b[d] = std::min(b[d], extents[level.active_count() - 1][axis++]);
  return b;
}

IntVec3 even_blocks(IntVec3 extents, const Level& level, const std::vector<GridBox>& boxes,
                    int threads) {
  constexpr int fewest_cells = 8;  // a thinner block recomputes more ghosts than cells
  if (threads == 1 || boxes.empty()) return extents;
  int axes[3] = {0, 0, 0}, count = 0;
  for (int d = 0; d < 3; ++d)
    if (level.active[static_cast<std::size_t>(d)]) axes[count++] = d;
  const int d = axes[count > 1 ? 1 : 0];
  const int n = boxes.front().cells.size()[d];
  int pieces = (n + extents[d] - 1) / extents[d];
  pieces = (pieces + threads - 1) / threads * threads;
  if (n / pieces >= fewest_cells) extents[d] = (n + pieces - 1) / pieces;
  return extents;
}

std::vector<Block> place_blocks(const std::vector<GridBox>& boxes, IntVec3 extents) {
  std::vector<Block> blocks;
  for (std::size_t n = 0; n < boxes.size(); ++n) {
    const IndexBox& box = boxes[n].cells;
    IntVec3 pieces{};
    for (int d = 0; d < 3; ++d)
      pieces[d] = std::max(1, (box.size()[d] + extents[d] - 1) / extents[d]);
    for (const IndexBox& piece : split(box, pieces))
      blocks.push_back({static_cast<int>(n), piece, true, 0});
  }
  return blocks;
}

}  // namespace sluice
