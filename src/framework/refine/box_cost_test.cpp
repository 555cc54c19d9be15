// Costs carried from measured boxes to new ones.
#include "framework/refine/box_cost.hpp"

#include <gtest/gtest.h>

namespace sluice::box_cost_test {
namespace {

TEST(BoxCost, CellsKeepTheirCost) {
  const std::vector<GridBox> measured = {{{{0, 0, 0}, {10, 10, 1}}, 0, 0},
                                         {{{10, 0, 0}, {20, 10, 1}}, 0, 1}};
  const std::vector<double> costs = {1.0, 3.0};  // a cell: 0.01 and 0.03, on average 0.02
  const std::vector<GridBox> boxes = {{{{0, 0, 0}, {5, 10, 1}}, 0, 0},
                                      {{{5, 0, 0}, {15, 10, 1}}, 0, 1},
                                      {{{15, 0, 0}, {25, 10, 1}}, 0, 2},
                                      {{{40, 0, 0}, {45, 10, 1}}, 0, 3}};
  const std::vector<double> expected = {0.5, 2.0, 2.5, 1.0};
  const std::vector<double> carried = carried_costs(measured, costs, boxes);
  ASSERT_EQ(carried.size(), expected.size());
  for (std::size_t b = 0; b < carried.size(); ++b) EXPECT_NEAR(carried[b], expected[b], 1e-14);
  EXPECT_EQ(carried_costs(measured, costs, measured), costs);
}

TEST(BoxCost, NothingMeasuredIsNothingSaid) {
  const std::vector<GridBox> boxes = {{{{0, 0, 0}, {5, 10, 1}}, 0, 0}};
  EXPECT_TRUE(carried_costs({}, {}, boxes).empty());
  EXPECT_TRUE(carried_costs(boxes, {0.0}, boxes).empty());
}

// Four boxes in a row, two of each rank; the first costs as much as the others together.
TEST(BoxCost, BoxesMoveWhereTheBusiestRankGainsEnough) {
  std::vector<GridBox> boxes;
  for (int b = 0; b < 4; ++b) boxes.push_back({{{4 * b, 0, 0}, {4 * b + 4, 1, 1}}, b / 2, b});
  const std::vector<double> costs = {3, 1, 1, 1};  // 4 and 2; at best 3 and 3, a quarter less
  const auto owners = [&](double least_gain) {
    std::vector<int> found;
    for (const GridBox& b : better_owners(boxes, costs, 2, least_gain)) found.push_back(b.owner);
    return found;
  };
  EXPECT_EQ(owners(.2), (std::vector<int>{0, 1, 1, 1}));
  EXPECT_EQ(owners(.24), (std::vector<int>{0, 1, 1, 1}));
  EXPECT_TRUE(owners(.26).empty());
  EXPECT_TRUE(better_owners(boxes, {1, 1, 1, 1}, 2, 0).empty());  // nothing to gain
  EXPECT_TRUE(better_owners(boxes, {0, 0, 0, 0}, 2, 0).empty());  // nothing measured
}

}  // namespace
}  // namespace sluice::box_cost_test
