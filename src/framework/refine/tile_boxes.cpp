// From tiles to boxes: merged as large as ranks and threads allow, in whole tiles.
#include "framework/refine/tile_boxes.hpp"

#include <algorithm>

namespace sluice {

namespace {

constexpr int boxes_a_rank = 4;             // so that ranks can be balanced
constexpr std::int64_t min_shared = 16384;  // cells of a box worth a thread of its own

// The longest direction in cells with more than one tile; of equal ones the last, so that rows
// along x stay long. -1 when there is one tile.
int longest(const TileLayout& layout, const IndexBox& tiles) {
  const IntVec3 size = layout.cells(tiles).size();
  int best = -1;
  for (int d = 0; d < 3; ++d)
    if (tiles.size()[d] > 1 && (best < 0 || size[d] >= size[best])) best = d;
  return best;
}

std::vector<IndexBox> split_above(const TileLayout& layout, std::vector<IndexBox> open,
                                  std::int64_t max_cells) {
  std::vector<IndexBox> done;
  while (!open.empty()) {
    const IndexBox block = open.back();
    open.pop_back();
    const int d = longest(layout, block);
    if (d < 0 || layout.cells(block).volume() <= max_cells) {
      done.push_back(block);
      continue;
    }
    IndexBox low = block, high = block;
    low.upper[d] = high.lower[d] = block.lower[d] + block.size()[d] / 2;
    open.push_back(high);
    open.push_back(low);
  }
  return done;
}

}  // namespace

std::vector<GridBox> boxes_of_tiles(const TileLayout& layout, const FlagField& tiles, int ranks,
                                    int threads, std::int64_t max_cells) {
  std::vector<IndexBox> blocks = merged_tiles(tiles);
  std::int64_t total = 0;
  for (const IndexBox& b : blocks) total += layout.cells(b).volume();
  std::int64_t most = total;
  if (ranks > 1)
    most = total / (boxes_a_rank * ranks);
  else if (threads > 1)
    most = std::max(total / threads, min_shared);
  if (max_cells > 0) most = std::min(most, max_cells);
  const std::int64_t wanted = std::min<std::int64_t>(ranks, tiles.count());
  blocks = split_above(layout, std::move(blocks), most);
  while (static_cast<std::int64_t>(blocks.size()) < wanted)
    blocks = split_above(layout, std::move(blocks), most /= 2);
  std::sort(blocks.begin(), blocks.end(), [](const IndexBox& a, const IndexBox& b) {
    const IntVec3 p = a.lower, q = b.lower;
    return p.z != q.z ? p.z < q.z : p.y != q.y ? p.y < q.y : p.x < q.x;
  });
  std::vector<GridBox> boxes;
  for (const IndexBox& b : blocks)
    boxes.push_back({layout.cells(b), 0, static_cast<int>(boxes.size())});
  assign_owners(boxes, ranks);
  return boxes;
}

}  // namespace sluice
