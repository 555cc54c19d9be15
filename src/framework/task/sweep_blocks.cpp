// Extents of blocks, and cutting.
#include "framework/task/sweep_blocks.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace sluice {

IntVec3 default_block(const Level& level, BlockSize size) {
  // Measured best: long rows, and as few recomputed ghosts as the cache allows. Blocks side by side
  // are swept as one, so that flat ones cost nothing: finer parts sleep or need the dearer graphs.
  // By active axes.
  constexpr int large[3][3] = {{512, 1, 1}, {256, 16, 1}, {128, 48, 128}};
  constexpr int small[3][3] = {{512, 1, 1}, {128, 16, 1}, {64, 16, 16}};
  const auto& extents = size == BlockSize::small ? small : large;
  constexpr int flat_row = 448;  // of a finer level: its boxes are low, and hardly any part sleeps
  IntVec3 b = level.domain.size();
  int axis = 0;
  for (int d = 0; d < 3; ++d)
    if (level.active[d]) b[d] = std::min(b[d], extents[level.active_count() - 1][axis++]);
  if (level.index > 0 && level.active_count() == 2) {
    const int d = level.active[0] ? 0 : 1;
    b[d] = std::min(level.domain.size()[d], flat_row);
  }
  return b;
}

IntVec3 balanced_block_extents(IntVec3 extents, const Level& level,
                               const std::vector<GridBox>& boxes, int threads) {
  constexpr int fewest_cells = 8;  // a thinner block recomputes more ghosts than cells
  if (threads == 1 || boxes.empty()) return extents;
  int axes[3] = {0, 0, 0}, count = 0;
  for (int d = 0; d < 3; ++d)
    if (level.active[d]) axes[count++] = d;
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

namespace {

// A stack as it grows: its last block, and what the planes of the whole stack span.
struct Stack {
  IndexBox last, hull;
  IndexBox widest;  // the plane of a block
  std::int64_t cells = 0;
  std::vector<std::size_t> blocks;
};

IndexBox across(IndexBox box, int swept) {
  box.lower[swept] = 0;
  box.upper[swept] = 1;
  return box;
}

// Rings of a stack are as wide as its hull: they must fit the cache as those of blocks do. In three
// directions the corners of the hull cost what is computed there in vain.
bool narrow(const IndexBox& hull, const IndexBox& widest, bool three) {
  return three ? 10 * hull.volume() <= 11 * widest.volume() : hull.volume() <= 2 * widest.volume();
}

const IndexBox& wider(const IndexBox& a, const IndexBox& b) {
  return a.volume() < b.volume() ? b : a;
}

}  // namespace

std::vector<std::vector<std::size_t>> stack_blocks(const std::vector<Block>& blocks,
                                                   const Level& level, std::int64_t max_cells) {
  std::vector<std::vector<std::size_t>> stacks;
  const int swept = level.active[2] ? 2 : level.active[1] ? 1 : 0;
  std::vector<std::size_t> order(blocks.size());
  for (std::size_t n = 0; n < order.size(); ++n) order[n] = n;
  if (level.active_count() < 2) {
    for (const std::size_t n : order) stacks.push_back({n});
    return stacks;
  }
  const auto low = [&](std::size_t n) { return blocks[n].cells.lower[swept]; };
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return low(a) < low(b); });
  std::vector<Stack> all;
  // Stacks by where they end, as far as blocks that begin there are still to come.
  std::map<int, std::vector<std::size_t>> open;
  for (const std::size_t n : order) {
    const IndexBox& cells = blocks[n].cells;
    const IndexBox plane = across(cells, swept);
    open.erase(open.begin(), open.lower_bound(low(n)));
    std::vector<std::size_t>& below = open[low(n)];
    std::size_t best = below.size();
    std::int64_t most = 0;
    for (std::size_t s = 0; s < below.size(); ++s) {
      const Stack& stack = all[below[s]];
      const std::int64_t common = intersection(across(stack.last, swept), plane).volume();
      if (common <= most || stack.cells + cells.volume() > max_cells) continue;
      if (!narrow(bounding(stack.hull, plane), wider(stack.widest, plane),
                  level.active_count() == 3))
        continue;
      most = common;
      best = s;
    }
    std::size_t here = all.size();
    if (best < below.size()) {
      here = below[best];
      below.erase(below.begin() + static_cast<std::ptrdiff_t>(best));
    } else {
      all.push_back({cells, plane, plane, 0, {}});
    }
    Stack& stack = all[here];
    stack.last = cells;
    stack.hull = bounding(stack.hull, plane);
    stack.widest = wider(stack.widest, plane);
    stack.cells += cells.volume();
    stack.blocks.push_back(n);
    open[cells.upper[swept]].push_back(here);
  }
  for (Stack& stack : all) stacks.push_back(std::move(stack.blocks));
  return stacks;
}

}  // namespace sluice
