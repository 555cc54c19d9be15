// Which nodes lie on walls: an L of two boxes.
#include "framework/grid/gaps.hpp"

#include <gtest/gtest.h>

namespace sluice::gaps_test {
namespace {

// Cells 0 to 9 by 0 to 3, and 0 to 3 by 4 to 9.
Level an_l() {
  Level level;
  level.domain = {{0, 0, 0}, {10, 10, 1}};
  level.active = {true, true, false};
  level.boxes = {{{{0, 0, 0}, {10, 4, 1}}, 0, 0}, {{{0, 4, 0}, {4, 10, 1}}, 0, 1}};
  return level;
}

TEST(Gaps, AreFoundByTheCellsThatNoBoxHas) {
  Level level = an_l();
  EXPECT_TRUE(has_gaps(level));
  level.boxes.push_back({{{4, 4, 0}, {10, 10, 1}}, 0, 2});
  EXPECT_FALSE(has_gaps(level));
}

TEST(Gaps, NodesOfCellsOutsideAreOnWalls) {
  const Level level = an_l();
  for (const IntVec3 node :
       {IntVec3{4, 4, 0}, {4, 7, 0}, {7, 4, 0}, {4, 10, 0}, {10, 4, 0}, {7, 7, 0}, {10, 10, 0}})
    EXPECT_TRUE(lies_on_gap(level, node)) << node.x << ' ' << node.y;
  for (const IntVec3 node : {IntVec3{3, 4, 0},
                             {3, 7, 0},
                             {7, 3, 0},
                             {0, 0, 0},
                             {0, 10, 0},
                             {10, 0, 0},
                             {3, 3, 0},
                             {-1, 2, 0},
                             {12, 3, 0}})
    EXPECT_FALSE(lies_on_gap(level, node)) << node.x << ' ' << node.y;
}

}  // namespace
}  // namespace sluice::gaps_test
