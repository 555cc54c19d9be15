// Covered and uncovered cells against a look at every cell, with many holes as well.
#include "framework/refine/coverage.hpp"

#include <random>

#include "framework/refine/box_pieces.hpp"
#include "framework/refine/transfer_test_support.hpp"

namespace sluice::coverage_test {
namespace {

using namespace transfer_test;

IntVec3 layer_of(const Level& level) {
  IntVec3 layer{};
  for (int d = 0; d < 3; ++d) layer[d] = level.active[d] ? 1 : 0;
  return layer;
}

// Is a cell, or the one that it is the periodic image of, under the finer level.
bool is_covered_anywhere(const Levels& levels, IntVec3 c) {
  const IndexBox& domain = levels.coarse.domain;
  for (int d = 0; d < 3; ++d) {
    if (!levels.coarse.periodic[d]) continue;
    const int n = domain.size()[d];
    c[d] = domain.lower[d] + (c[d] - domain.lower[d] + n) % n;
  }
  return holds(levels.fine, c * levels.fine.ratio);
}

void expect_partition(const Levels& levels) {
  const LevelCoverage coverage(levels.coarse, &levels.fine, world().rank());
  EXPECT_EQ(coverage.any(), !levels.fine.boxes.empty());
  const int row = row_direction(levels.coarse.active);
  int local = 0;
  std::int64_t cells = 0;
  for (const GridBox& b : levels.coarse.boxes) {
    if (b.owner != world().rank()) continue;
    for_each_cell(b.cells, [&](IntVec3 c) {
      const bool covered = holds(levels.fine, c * levels.fine.ratio);
      int pieces = 0;
      for (const IndexBox& piece : coverage.uncovered(local)) pieces += piece.contains(c);
      ASSERT_EQ(pieces, covered ? 0 : 1);
      ASSERT_EQ(coverage.is_covered(local, c), covered);
      int segments = 0, last = b.cells.lower[row];
      for (const LevelCoverage::Segment& part : coverage.uncovered_in_row(local, c)) {
        segments += c[row] >= part.first && c[row] < part.first + part.count;
        ASSERT_GE(part.first, last);
        last = part.first + part.count;
      }
      ASSERT_LE(last, b.cells.upper[row]);
      ASSERT_EQ(segments, pieces);
      cells += !covered;
    });
    for (const IndexBox& piece : coverage.uncovered(local)) EXPECT_TRUE(b.cells.contains(piece));
    for_each_cell(b.cells.grown(layer_of(levels.coarse)), [&](IntVec3 c) {
      ASSERT_EQ(coverage.is_covered_around(local, c), is_covered_anywhere(levels, c));
    });
    ++local;
  }
  EXPECT_EQ(coverage.uncovered_cells(), cells);
  if (local > 0) {
    EXPECT_FALSE(coverage.is_covered(0, levels.coarse.domain.upper));
  }
}

TEST(LevelCoverage, parts_the_cells) {
  for (const Shape& shape : all_shapes()) expect_partition(Levels(shape));
}

TEST(LevelCoverage, parts_the_cells_around_many_holes) {
  std::mt19937 random(5);
  Shape shape{{{0, 0, 0}, {60, 50, 1}}, {}, {2, 2, 1}, {}};
  for (int j = 0; j < 48; j += 3)
    for (int i = 0; i < 58; i += 3)
      if (random() % 3 != 0)
        shape.fine.push_back({{i, j, 0}, {i + 1 + static_cast<int>(random() % 3), j + 2, 1}});
  expect_partition(Levels(shape));
}

TEST(LevelCoverage, is_nothing_without_a_finer_level) {
  Levels levels({{{0, 0, 0}, {8, 8, 1}}, {}, {2, 2, 1}, {{{2, 2, 0}, {4, 4, 1}}}});
  levels.fine.boxes.clear();
  const LevelCoverage coverage(levels.coarse, nullptr, levels.coarse.boxes[0].owner);
  EXPECT_FALSE(coverage.any());
  EXPECT_EQ(coverage.uncovered_cells(), 64);
  EXPECT_EQ(coverage.uncovered(0), std::vector<IndexBox>{levels.coarse.domain});
  EXPECT_FALSE(coverage.is_covered(0, {3, 3, 0}));
  expect_partition(levels);
}

TEST(BoxPieces, ring_around_a_box_is_four_pieces_with_long_rows) {
  const IndexBox box{{0, 0, 0}, {16, 16, 1}};
  const std::vector<IndexBox> ring = pieces_without(box.grown({3, 3, 0}), {box}, 0);
  EXPECT_EQ(ring.size(), 4u);
  std::int64_t rows = 0;
  for (const IndexBox& r : ring) rows += r.size().y;
  EXPECT_EQ(rows, 3 + 3 + 16 + 16);
}

TEST(BoxPieces, neighbours_are_joined) {
  std::vector<IndexBox> checks;
  for_each_cell({{0, 0, 0}, {4, 3, 2}}, [&](IntVec3 c) {
    checks.push_back({c, c + IntVec3::all(1)});
  });
  for (int row = 0; row < 3; ++row)
    EXPECT_EQ(joined(checks, row), (std::vector<IndexBox>{{{0, 0, 0}, {4, 3, 2}}}));
}

TEST(BoxPieces, images_go_round_as_often_as_needed) {
  Level level;
  level.domain = {{2, 0, 0}, {4, 5, 1}};
  level.active = {true, true, false};
  level.periodic = {true, false, false};
  const std::vector<IntVec3> shifts = image_shifts(level, {{-3, 0, 0}, {7, 2, 1}}, 1);
  std::vector<IntVec3> wanted;
  // The region holds cells -3 to 6, the domain and its ghosts 1 to 4.
  for (int k = -5; k <= 5; ++k)
    if (!intersection({{-3 + 2 * k, 0, 0}, {7 + 2 * k, 2, 1}}, {{1, 0, 0}, {5, 5, 1}}).empty())
      wanted.push_back({2 * k, 0, 0});
  EXPECT_EQ(shifts, wanted);
}

}  // namespace
}  // namespace sluice::coverage_test
