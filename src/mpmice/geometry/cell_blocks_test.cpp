// Blocks of cells: where cells lie, in which order they are visited, who is beside whom.
#include "mpmice/geometry/cell_blocks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "framework/base/close_ranks_test_support.hpp"
#include "mpmice/geometry/occupied_cells.hpp"

namespace sluice::mpmice::cell_blocks {
namespace {

template <int D>
Cell<D> at(int i) {
  Cell<D> c;
  for (std::size_t d = 0; d < D; ++d) c[d] = i + static_cast<int>(d);
  return c;
}

// Two boxes far from each other, below zero and above.
template <int D>
CellBlocks<D> two_boxes() {
  CellBlocks<D> blocks;
  CellBox<D> room, low, high;
  for (std::size_t d = 0; d < D; ++d) {
    room.lower[d] = -1000;
    room.upper[d] = 1000;
    low.lower[d] = -777 + static_cast<int>(d);
    low.upper[d] = low.lower[d] + 9;
    high.lower[d] = 600;
    high.upper[d] = 611;
  }
  blocks.begin(room);
  blocks.add(high);
  blocks.add(low);
  blocks.add(low);
  blocks.finish();
  return blocks;
}

template <int D>
void check_places() {
  const CellBlocks<D> blocks = two_boxes<D>();
  std::set<std::size_t> places;
  std::vector<Cell<D>> cells;
  CellBox<D> everything;
  everything.lower.fill(-2000);
  everything.upper.fill(2000);
  blocks.for_each_cell(everything, [&](const Cell<D>& c, std::size_t i) {
    EXPECT_EQ(blocks.index(c), i);
    EXPECT_TRUE(blocks.holds(c));
    EXPECT_GE(i, CellBlocks<D>::block_cells);
    EXPECT_LT(i, blocks.size());
    places.insert(i);
    cells.push_back(c);
  });
  EXPECT_EQ(places.size(), blocks.block_count() * CellBlocks<D>::block_cells);
  EXPECT_EQ(cells.size(), places.size());
  // z slowest, x fastest, whatever the blocks.
  EXPECT_TRUE(std::is_sorted(cells.begin(), cells.end(), [](const Cell<D>& a, const Cell<D>& b) {
    return std::lexicographical_compare(a.rbegin(), a.rend(), b.rbegin(), b.rend());
  }));
  for (const Cell<D>& c : cells)
    for (std::size_t d = 0; d < D; ++d) {
      Cell<D> above = c;
      ++above[d];
      const std::size_t i = blocks.cell_above(blocks.index(c), static_cast<int>(d));
      EXPECT_EQ(i, blocks.index(above));
      EXPECT_EQ(blocks.holds(above), i >= CellBlocks<D>::block_cells);
      if (blocks.holds(above)) {
        EXPECT_GE(i / 64, blocks.index(c) / 64);
      }
    }
  // Nothing is between them, nor beyond the room.
  EXPECT_FALSE(blocks.holds(at<D>(0)));
  EXPECT_FALSE(blocks.holds(at<D>(5000)));
  EXPECT_FALSE(blocks.holds(at<D>(-5000)));
  EXPECT_LT(blocks.index(at<D>(3)), CellBlocks<D>::block_cells);
  EXPECT_THROW((void)blocks.index_to_add(at<D>(3)), std::out_of_range);
}

TEST(CellBlocks, HaveOnePlaceForEachCellInItsOrder) {
  check_places<1>();
  check_places<2>();
  check_places<3>();
}

template <int D>
void check_parts() {
  const CellBlocks<D> blocks = two_boxes<D>();
  CellBox<D> box;
  box.lower.fill(603);
  box.upper.fill(800);
  std::set<Cell<D>> found, expected;
  blocks.for_each_part(box, [&](const CellBox<D>& part) {
    for_each_cell_of<D>(part, [&](const Cell<D>& c) { EXPECT_TRUE(found.insert(c).second); });
  });
  blocks.for_each_cell(box, [&](const Cell<D>& c, std::size_t) { expected.insert(c); });
  EXPECT_EQ(found, expected);
  EXPECT_FALSE(found.empty());
}

TEST(CellBlocks, PartsOfABoxAreThoseThatHaveBlocks) {
  check_parts<1>();
  check_parts<2>();
  check_parts<3>();
}

TEST(CellBlocks, NoneAreNone) {
  CellBlocks<3> blocks;
  blocks.begin({});
  blocks.add({{0, 0, 0}, {4, 4, 4}});  // beyond the room
  blocks.finish();
  EXPECT_EQ(blocks.block_count(), 0u);
  EXPECT_EQ(blocks.size(), 64u);
  blocks.for_each_cell({{-9, -9, -9}, {9, 9, 9}}, [](const Cell<3>&, std::size_t) { FAIL(); });
}

// What is occupied is known to the cell, by block.
CellBox<2> hull_of(const OccupiedCells<2>& cells) {
  CellBox<2> hull;
  for (const CellBox<2>& box : cells.boxes()) hull.include(box);
  return hull;
}

TEST(OccupiedCells, AreTheSmallestBoxesOfTheirBlocks) {
  OccupiedCells<2> cells;
  cells.begin({{-20, -20}, {20, 20}});
  EXPECT_TRUE(cells.boxes().empty());
  cells.add({{1, 2}, {3, 4}});
  cells.add({{3, 5}, {5, 6}});
  cells.add({{-30, 0}, {-19, 1}});  // cut at the room
  ASSERT_EQ(cells.boxes().size(), 2u);
  EXPECT_EQ(cells.boxes()[0], (CellBox<2>{{1, 2}, {5, 6}}));
  EXPECT_EQ(cells.boxes()[1], (CellBox<2>{{-20, 0}, {-19, 1}}));
  EXPECT_EQ(hull_of(cells), (CellBox<2>{{-20, 0}, {5, 6}}));
  cells.add({{6, 6}, {10, 7}}, 2);  // in two blocks
  EXPECT_EQ(cells.boxes().size(), 3u);
  cells.grow();
  EXPECT_EQ(cells.boxes()[0], (CellBox<2>{{-1, 0}, {10, 9}}));  // may move by two
  EXPECT_EQ(cells.boxes()[1], (CellBox<2>{{-20, 0}, {-19, 1}}));
  EXPECT_EQ(cells.boxes()[2], (CellBox<2>{{6, 4}, {12, 9}}));
}

}  // namespace
}  // namespace sluice::mpmice::cell_blocks
