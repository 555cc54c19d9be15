// Tiles of even and uneven levels, tiles that hold flags, tiles merged into boxes.
#include "framework/refine/tile_layout.hpp"

#include <gtest/gtest.h>

#include <random>
#include <set>

#include "framework/refine/tile_boxes.hpp"

namespace sluice::tile_layout_test {
namespace {

Level level_of(IntVec3 coarse_cells, IntVec3 ratio) {
  Level level;
  level.index = 1;
  level.ratio = ratio;
  level.domain = {{0, 0, 0}, coarse_cells * ratio};
  return level;
}

TEST(TileLayout, TilesThatDivideTheLevelAreAllEqual) {
  const TileLayout layout(level_of({32, 16, 1}, {4, 2, 1}), {8, 16, 1});
  EXPECT_EQ(layout.count(), (IntVec3{16, 2, 1}));
  for_each_cell(layout.all(), [&](IntVec3 t) {
    EXPECT_EQ(layout.cells(t).size(), (IntVec3{8, 16, 1}));
    EXPECT_EQ(layout.cells(t).lower, t * (IntVec3{8, 16, 1}));
  });
}

TEST(TileLayout, UnevenTilesFillTheLevelAndAreMirrored) {
  for (const int ratio : {1, 2, 4})
    for (int coarse = 1; coarse < 90; ++coarse)
      for (const int tile : {4, 8, 12, 40}) {
        const TileLayout layout(level_of({coarse, 1, 1}, {ratio, 1, 1}), {tile, 1, 1});
        const int n = layout.count().x, cells = coarse * ratio;
        int at = 0;
        for (int t = 0; t < n; ++t) {
          const IndexBox here = layout.cells(IntVec3{t, 0, 0});
          const IndexBox mirror = layout.cells(IntVec3{n - 1 - t, 0, 0});
          EXPECT_EQ(here.lower.x, at);
          EXPECT_EQ(here.lower.x % ratio, 0);
          EXPECT_EQ(here.lower.x, cells - mirror.upper.x);
          EXPECT_GE(here.size().x, std::min(tile, cells));
          at = here.upper.x;
        }
        EXPECT_EQ(at, cells);
      }
}

TEST(TileLayout, TilesHoldTheFlagsOfTheirCells) {
  const std::pair<IntVec3, IntVec3> cases[] = {
      {{33, 21, 1}, {6, 8, 4}},   {{150, 8, 3}, {6, 8, 4}},  {{16, 16, 16}, {6, 8, 4}},
      {{150, 9, 1}, {2, 8, 2}},   {{152, 9, 1}, {8, 8, 2}},  {{512, 2, 1}, {32, 8, 2}},
      {{192, 2, 1}, {128, 8, 2}}, {{64, 2, 1}, {128, 8, 2}}, {{256, 2, 1}, {256, 8, 2}}};
  for (const auto& [coarse, tile] : cases) {
    const Level level = level_of(coarse, {2, 4, 2});
    const TileLayout layout(level, tile);
    FlagField flags(IndexBox{{0, 0, 0}, coarse}), expected(layout.all());
    std::mt19937 random(5);
    for (int n = 0; n < 12; ++n) {
      const auto below = [&](int end) {
        return static_cast<int>(random() % static_cast<unsigned>(end));
      };
      const IntVec3 c{below(coarse.x), below(coarse.y), below(coarse.z)};
      flags.set(c);
      for_each_cell(layout.all(), [&](IntVec3 t) {
        if (layout.cells(t).contains(c * level.ratio)) expected.set(t);
      });
    }
    EXPECT_EQ(layout.holding(flags), expected);
    flags.fill(flags.domain());
    EXPECT_EQ(layout.holding(flags).count(), layout.all().volume());
  }
  EXPECT_FALSE(TileLayout(level_of({8, 8, 1}, {2, 2, 1}), {8, 8, 1}).holding(FlagField()).any());
}

FlagField random_tiles(IntVec3 count, double share, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> chance(0, 1);
  FlagField tiles(IndexBox{{0, 0, 0}, count});
  for_each_cell(tiles.domain(), [&](IntVec3 t) {
    if (chance(random) < share) tiles.set(t);
  });
  return tiles;
}

TEST(MergedTiles, AreExactlyTheFlaggedOnes) {
  unsigned seed = 0;
  for (const IntVec3& count : {IntVec3{70, 20, 1}, IntVec3{1, 30, 1}, IntVec3{9, 8, 7}})
    for (const double share : {0.1, 0.5, 0.95}) {
      const FlagField tiles = random_tiles(count, share, ++seed);
      FlagField covered(tiles.domain());
      std::int64_t volume = 0;
      for (const IndexBox& b : merged_tiles(tiles)) {
        covered.fill(b);
        volume += b.volume();
      }
      EXPECT_EQ(covered, tiles);
      EXPECT_EQ(volume, tiles.count());
    }
}

TEST(MergedTiles, RectanglesAndBlocksBecomeOneBox) {
  FlagField tiles(IndexBox{{0, 0, 0}, {20, 20, 20}});
  const IndexBox block{{3, 4, 5}, {17, 9, 12}};
  tiles.fill(block);
  EXPECT_EQ(merged_tiles(tiles), (std::vector<IndexBox>{block}));
  tiles.fill({{3, 9, 5}, {16, 12, 12}});  // a second, shorter one behind it
  EXPECT_EQ(merged_tiles(tiles).size(), 2u);
  EXPECT_TRUE(merged_tiles(FlagField()).empty());
}

TEST(BoxesOfTiles, GiveEveryRankSome) {
  const TileLayout layout(level_of({64, 64, 1}, {2, 2, 1}), {8, 8, 1});
  FlagField tiles(layout.all());
  tiles.fill({{2, 3, 0}, {12, 9, 1}});
  tiles.fill({{14, 0, 0}, {15, 2, 1}});
  const std::int64_t cells = tiles.count() * 64;
  for (const int ranks : {1, 2, 5, 16, 62, 100})
    for (const int threads : {1, 4}) {
      FlagField covered(IndexBox{{0, 0, 0}, {128, 128, 1}});
      std::set<int> owners;
      std::int64_t total = 0, most = 0;
      std::vector<std::int64_t> load(ranks);
      for (const GridBox& b : boxes_of_tiles(layout, tiles, ranks, threads)) {
        EXPECT_FALSE(covered.any(b.cells));
        covered.fill(b.cells);
        owners.insert(b.owner);
        total += b.cells.volume();
        most = std::max(most, load[b.owner] += b.cells.volume());
      }
      EXPECT_EQ(total, cells);
      EXPECT_EQ(static_cast<std::int64_t>(owners.size()),
                std::min<std::int64_t>(ranks, tiles.count()));
      if (ranks <= 5) {
        EXPECT_LE(most, cells / ranks + cells / (2 * ranks));
      }
    }
  EXPECT_EQ(boxes_of_tiles(layout, tiles, 1, 1).size(), 2u);
  EXPECT_TRUE(boxes_of_tiles(layout, FlagField(layout.all()), 3, 1).empty());
}

}  // namespace
}  // namespace sluice::tile_layout_test
