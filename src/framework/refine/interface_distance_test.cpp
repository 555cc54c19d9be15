// Distances to the end of a level: by hand, against a search cell by cell, and however it is cut.
#include "framework/refine/interface_distance.hpp"

#include <gtest/gtest.h>

namespace sluice::interface_distance_test {
namespace {

constexpr int depth = 5, ghosts = 3;
constexpr IntVec3 depths{depth, depth, 0};

Level flat_level(const std::vector<IndexBox>& boxes, bool periodic_x = false) {
  Level level;
  level.index = 1;
  level.domain = {{0, 0, 0}, {40, 24, 1}};
  level.active = {true, true, false};
  level.periodic = {periodic_x, false, false};
  for (const IndexBox& b : boxes)
    level.boxes.push_back({b, 0, static_cast<int>(level.boxes.size())});
  return level;
}

IndexBox box(int x0, int y0, int x1, int y1) {
  return {{x0, y0, 0}, {x1, y1, 1}};
}

int distance(const InterfaceDistance& d, int box, int axis, bool high, IntVec3 cell) {
  const std::uint8_t* found = d.ahead(box, axis, high, cell);
  return found == nullptr ? depth + 1 : *found;
}

// Asks cell after cell ahead.
int search(const Level& level, int axis, bool high, IntVec3 cell) {
  for (int k = 0; k <= depth; ++k) {
    IntVec3 at = cell;
    at[axis] += high ? k : -k;
    if (level.periodic[0]) at.x = (at.x + level.domain.upper.x) % level.domain.upper.x;
    if (!level.domain.contains(at)) return depth + 1;
    bool here = false;
    for (const GridBox& b : level.boxes) here = here || b.cells.contains(at);
    if (!here) return k;
  }
  return depth + 1;
}

void expect_as_searched(const Level& level) {
  const InterfaceDistance distances(level, 0, depths, ghosts);
  int ends = 0;
  for (std::size_t b = 0; b < level.boxes.size(); ++b) {
    const IntVec3 around = level.ghosts(ghosts);
    const IndexBox cells{level.boxes[b].cells.lower - around, level.boxes[b].cells.upper + around};
    for_each_cell(cells, [&](IntVec3 c) {
      if (!level.domain.contains(c)) return;  // ghosts of the domain: never asked for at an end
      for (int axis = 0; axis < 2; ++axis)
        for (const bool high : {false, true}) {
          const int expected = search(level, axis, high, c);
          ends += expected <= depth ? 1 : 0;
          EXPECT_EQ(distance(distances, static_cast<int>(b), axis, high, c), expected)
              << c.x << ' ' << c.y << " axis " << axis << (high ? " high" : " low");
        }
    });
  }
  EXPECT_GT(ends, 0);
}

TEST(InterfaceDistance, CountsCellsUpToTheEnd) {
  const InterfaceDistance d(flat_level({box(8, 8, 28, 16)}), 0, depths, ghosts);
  EXPECT_EQ(distance(d, 0, 0, true, {27, 10, 0}), 1);
  EXPECT_EQ(distance(d, 0, 0, true, {23, 10, 0}), 5);
  EXPECT_EQ(distance(d, 0, 0, true, {22, 10, 0}), depth + 1);
  EXPECT_EQ(distance(d, 0, 0, true, {28, 10, 0}), 0);
  EXPECT_EQ(distance(d, 0, 0, false, {8, 10, 0}), 1);
  EXPECT_EQ(distance(d, 0, 1, true, {15, 15, 0}), 1);
  EXPECT_EQ(distance(d, 0, 1, true, {15, 10, 0}), depth + 1);
}

TEST(InterfaceDistance, IsWhatASearchFinds) {
  expect_as_searched(flat_level({box(8, 8, 28, 16)}));
  // An L, a gap as narrow as two cells, a hole, walls.
  expect_as_searched(flat_level({box(0, 4, 12, 20), box(12, 4, 20, 8), box(22, 4, 30, 8)}));
  expect_as_searched(
      flat_level({box(4, 4, 12, 8), box(4, 8, 8, 12), box(10, 8, 12, 12), box(4, 12, 12, 16)}));
  expect_as_searched(flat_level({box(30, 0, 40, 24)}));
}

TEST(InterfaceDistance, LooksAcrossPeriodicSides) {
  expect_as_searched(flat_level({box(30, 4, 40, 20), box(0, 4, 3, 20)}, true));
  expect_as_searched(flat_level({box(30, 4, 40, 20)}, true));
}

TEST(InterfaceDistance, DoesNotDependOnBoxes) {
  const IndexBox whole = box(8, 8, 28, 16);
  const InterfaceDistance one(flat_level({whole}), 0, depths, ghosts);
  const std::vector<IndexBox> cuts = {box(8, 8, 11, 12), box(11, 8, 28, 12), box(8, 12, 26, 16),
                                      box(26, 12, 28, 16)};
  const InterfaceDistance four(flat_level(cuts), 0, depths, ghosts);
  for (int b = 0; b < 4; ++b)
    for_each_cell(cuts[b], [&](IntVec3 c) {
      for (int axis = 0; axis < 2; ++axis)
        for (const bool high : {false, true})
          EXPECT_EQ(distance(four, b, axis, high, c), distance(one, 0, axis, high, c));
    });
}

TEST(InterfaceDistance, HoldsNothingWhereNobodyAsksOrNothingEnds) {
  EXPECT_TRUE(InterfaceDistance().empty());
  EXPECT_TRUE(InterfaceDistance(flat_level({box(8, 8, 28, 16)}), 0, {}, ghosts).empty());
  EXPECT_TRUE(InterfaceDistance(flat_level({box(0, 0, 40, 24)}), 0, depths, ghosts).empty());
  const InterfaceDistance x(flat_level({box(8, 8, 28, 16)}), 0, {depth, 0, 0}, ghosts);
  EXPECT_NE(x.ahead(0, 0, true, {20, 10, 0}), nullptr);
  EXPECT_EQ(x.ahead(0, 1, true, {20, 10, 0}), nullptr);
  EXPECT_TRUE(InterfaceDistance(flat_level({box(8, 8, 28, 16)}), 1, depths, ghosts).empty());
}

}  // namespace
}  // namespace sluice::interface_distance_test
