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
  std::vector<int> edges(n + 1);
  for (int t = 0; t <= n; ++t) edges[t] = 2 * t <= n ? edge(t) : coarse_cells - edge(n - t);
  return edges;
}

}  // namespace

TileLayout::TileLayout(const Level& level, IntVec3 tile)
    : ratio_(level.ratio), lower_(level.domain.lower) {
  for (int d = 0; d < 3; ++d) {
    const int coarse = level.domain.size()[d] / ratio_[d];
    auto& edges = edges_[d];
    edges = divide(coarse, tile[d], ratio_[d]);
    count_[d] = static_cast<int>(edges.size()) - 1;
  }
  const int width = edges_[0][1];
  if (width * count_.x == edges_[0].back() && (width & (width - 1)) == 0 && width <= 64)
    width_along_x_ = width;
  tile_along_x_.resize(edges_[0].back());
  for (int t = 0; t < count_.x; ++t)
    std::fill(tile_along_x_.begin() + edges_[0][t], tile_along_x_.begin() + edges_[0][t + 1], t);
}

IndexBox TileLayout::cells(const IndexBox& tiles) const {
  IndexBox box;
  for (int d = 0; d < 3; ++d) {
    const auto& edges = edges_[d];
    box.lower[d] = lower_[d] + edges[tiles.lower[d]] * ratio_[d];
    box.upper[d] = lower_[d] + edges[tiles.upper[d]] * ratio_[d];
  }
  return box;
}

namespace {

using Word = std::uint64_t;

// The bits at even places, moved together.
Word even_bits(Word v) {
  v &= 0x5555555555555555u;
  v = (v | v >> 1) & 0x3333333333333333u;
  v = (v | v >> 2) & 0x0f0f0f0f0f0f0f0fu;
  v = (v | v >> 4) & 0x00ff00ff00ff00ffu;
  v = (v | v >> 8) & 0x0000ffff0000ffffu;
  return (v | v >> 16) & 0x00000000ffffffffu;
}

// Bit t of `tiles`: whether one of the cells [t width, (t + 1) width) is set; a power of two.
void halve(const std::vector<Word>& cells, int width, Word* tiles, std::size_t tile_words) {
  const int a_word = 64 / width;
  for (std::size_t w = 0; w < cells.size(); ++w) {
    Word v = cells[w];
    for (int done = 1; done < width; done *= 2) v = even_bits(v | v >> 1);
    const std::size_t bit = w * a_word;
    if (bit / 64 < tile_words) tiles[bit / 64] |= v << (bit % 64);
  }
}

}  // namespace

void TileLayout::hold_row(const std::vector<Word>& cells, Word* tiles,
                          std::size_t tile_words) const {
  if (width_along_x_ > 0) {
    halve(cells, width_along_x_, tiles, tile_words);
    return;
  }
  const int n = edges_[0].back();
  for (int x = next_flag(cells.data(), 0, n); x < n;) {
    const int tile = tile_along_x_[x];
    tiles[tile / 64] |= Word{1} << (tile % 64);
    x = next_flag(cells.data(), edges_[0][tile + 1], n);
  }
}

FlagField TileLayout::holding(const FlagField& coarse_flags) const {
  FlagField tiles(all());
  if (coarse_flags.words().empty()) return tiles;
  if (coarse_flags.domain().size().y == 1 && coarse_flags.domain().size().z == 1) {
    hold_row(coarse_flags.words(), tiles.row(0, 0), tiles.words_a_row());
    return tiles;
  }
  std::vector<Word> joined(coarse_flags.words_a_row());
  for (int tz = 0; tz < count_.z; ++tz)
    for (int ty = 0; ty < count_.y; ++ty) {
      std::fill(joined.begin(), joined.end(), Word{0});
      for (int z = edges_[2][tz]; z < edges_[2][tz + 1]; ++z)
        for (int y = edges_[1][ty]; y < edges_[1][ty + 1]; ++y) {
          const Word* row = coarse_flags.row(y, z);
          for (std::size_t w = 0; w < joined.size(); ++w) joined[w] |= row[w];
        }
      hold_row(joined, tiles.row(ty, tz), tiles.words_a_row());
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
    for (int y = 0; y < n.y; ++y) {
      const bool as_before =
          y > 0 &&
          std::equal(tiles.row(y, z), tiles.row(y, z) + tiles.words_a_row(), tiles.row(y - 1, z));
      if (as_before)
        for (IndexBox& b : open_rows) b.upper.y = y + 1;
      else
        join(open_rows, runs_of_row(tiles, y, z), 1, plane);
    }
    join(open_rows, {}, 1, plane);
    std::sort(plane.begin(), plane.end(), before);
    if (n.z == 1) return plane;
    join(open_planes, plane, 2, blocks);
  }
  join(open_planes, {}, 2, blocks);
  std::sort(blocks.begin(), blocks.end(), [](const IndexBox& a, const IndexBox& b) {
    return a.lower.z != b.lower.z ? a.lower.z < b.lower.z : before(a, b);
  });
  return blocks;
}

}  // namespace sluice
