// Dividing a level into tiles, finding those that flags ask for, merging them into large boxes.
#include "framework/refine/tile_layout.hpp"

#include <algorithm>

namespace sluice {

namespace {

// Low edges of the tiles and the end of the last one.
std::vector<int> divide(int coarse_cells, int tile_cells, int ratio) {
  int n = std::max(1, coarse_cells * ratio / tile_cells);
  if (n % 2 == 0 && coarse_cells % 2 == 1) --n;
  const auto edge = [&](int t) {
    return static_cast<int>(static_cast<std::int64_t>(coarse_cells) * t / n);
  };
  std::vector<int> edges(static_cast<std::size_t>(n) + 1);
  for (int t = 0; t <= n; ++t)
    edges[static_cast<std::size_t>(t)] = 2 * t <= n ? edge(t) : coarse_cells - edge(n - t);
  return edges;
}

}  // namespace

TileLayout::TileLayout(const Level& level, IntVec3 tile)
    : ratio_(level.ratio), lower_(level.domain.lower) {
  for (int d = 0; d < 3; ++d) {
    const int coarse = level.domain.size()[d] / ratio_[d];
    auto& edges = edges_[static_cast<std::size_t>(d)];
    edges = divide(coarse, tile[d], ratio_[d]);
    count_[d] = static_cast<int>(edges.size()) - 1;
  }
  tile_along_x_.resize(static_cast<std::size_t>(edges_[0].back()));
  for (int t = 0; t < count_.x; ++t)
    std::fill(tile_along_x_.begin() + edges_[0][static_cast<std::size_t>(t)],
              tile_along_x_.begin() + edges_[0][static_cast<std::size_t>(t) + 1], t);
}

IndexBox TileLayout::cells(const IndexBox& tiles) const {
  IndexBox box;
  for (int d = 0; d < 3; ++d) {
    const auto& edges = edges_[static_cast<std::size_t>(d)];
    box.lower[d] = lower_[d] + edges[static_cast<std::size_t>(tiles.lower[d])] * ratio_[d];
    box.upper[d] = lower_[d] + edges[static_cast<std::size_t>(tiles.upper[d])] * ratio_[d];
  }
  return box;
}

FlagField TileLayout::holding(const FlagField& coarse_flags) const {
  FlagField tiles(all());
  if (coarse_flags.words().empty()) return tiles;
  const std::size_t words = coarse_flags.words_a_row();
  const int cells = edges_[0].back();
  std::vector<std::uint64_t> joined(words);
  for (int tz = 0; tz < count_.z; ++tz)
    for (int ty = 0; ty < count_.y; ++ty) {
      std::fill(joined.begin(), joined.end(), std::uint64_t{0});
      for (int z = edges_[2][static_cast<std::size_t>(tz)];
           z < edges_[2][static_cast<std::size_t>(tz) + 1]; ++z)
        for (int y = edges_[1][static_cast<std::size_t>(ty)];
             y < edges_[1][static_cast<std::size_t>(ty) + 1]; ++y) {
          const std::uint64_t* row = coarse_flags.row(y, z);
          for (std::size_t w = 0; w < words; ++w) joined[w] |= row[w];
        }
      for (int x = next_flag(joined.data(), 0, cells); x < cells;) {
        const int tx = tile_along_x_[static_cast<std::size_t>(x)];
        tiles.set({tx, ty, tz});
        x = next_flag(joined.data(), edges_[0][static_cast<std::size_t>(tx) + 1], cells);
      }
    }
  return tiles;
}

namespace {

bool before(const IndexBox& a, const IndexBox& b) {
  return a.lower.y != b.lower.y ? a.lower.y < b.lower.y : a.lower.x < b.lower.x;
}

// Joins each box of `next` to the one of `open` that it continues along direction d with the same
// extents in the directions below d; what is not continued is done.
void join(std::vector<IndexBox>& open, const std::vector<IndexBox>& next, int d,
          std::vector<IndexBox>& done) {
  std::vector<IndexBox> now;
  std::size_t o = 0;
  for (const IndexBox& b : next) {
    while (o < open.size() &&
           before({{open[o].lower.x, d == 1 ? b.lower.y : open[o].lower.y, 0}, {}}, b))
      done.push_back(open[o++]);
    const bool same = o < open.size() && open[o].upper[d] == b.lower[d] &&
                      open[o].lower.x == b.lower.x && open[o].upper.x == b.upper.x &&
                      (d == 1 || (open[o].lower.y == b.lower.y && open[o].upper.y == b.upper.y));
    now.push_back(b);
    if (same) now.back().lower[d] = open[o++].lower[d];
  }
  done.insert(done.end(), open.begin() + static_cast<std::ptrdiff_t>(o), open.end());
  open = std::move(now);
}

std::vector<IndexBox> runs_of_row(const FlagField& tiles, int y, int z) {
  std::vector<IndexBox> runs;
  const int n = tiles.domain().size().x;
  const std::uint64_t* row = tiles.row(y, z);
  for (int x = next_flag(row, 0, n); x < n;) {
    const int end = next_gap(row, x, n);
    runs.push_back({{x, y, z}, {end, y + 1, z + 1}});
    x = next_flag(row, end, n);
  }
  return runs;
}

}  // namespace

std::vector<IndexBox> merged_tiles(const FlagField& tiles) {
  const IntVec3 n = tiles.domain().empty() ? IntVec3{} : tiles.domain().size();
  std::vector<IndexBox> blocks, open_planes;
  for (int z = 0; z < n.z; ++z) {
    std::vector<IndexBox> plane, open_rows;
    for (int y = 0; y < n.y; ++y) join(open_rows, runs_of_row(tiles, y, z), 1, plane);
    join(open_rows, {}, 1, plane);
    std::sort(plane.begin(), plane.end(), before);
    join(open_planes, plane, 2, blocks);
  }
  join(open_planes, {}, 2, blocks);
  std::sort(blocks.begin(), blocks.end(), [](const IndexBox& a, const IndexBox& b) {
    return a.lower.z != b.lower.z ? a.lower.z < b.lower.z : before(a, b);
  });
  return blocks;
}

}  // namespace sluice
