// Index boxes, levels, cutting a level into boxes and dealing them out.
#include "framework/grid/level.hpp"

#include <gtest/gtest.h>

#include "framework/grid/side.hpp"

namespace sluice::level_test {
namespace {

TEST(IndexBox, SetOperations) {
  const IndexBox a{{0, 0, 0}, {4, 3, 2}}, b{{2, -1, 0}, {6, 2, 1}};
  EXPECT_EQ(a.volume(), 24);
  EXPECT_EQ(intersection(a, b), (IndexBox{{2, 0, 0}, {4, 2, 1}}));
  EXPECT_EQ(bounding(a, b), (IndexBox{{0, -1, 0}, {6, 3, 2}}));
  EXPECT_TRUE(intersection(a, b.shifted({5, 0, 0})).empty());
  EXPECT_EQ(intersection(a, b.shifted({5, 0, 0})).volume(), 0);
  EXPECT_TRUE(a.contains(IntVec3{3, 2, 1}));
  EXPECT_FALSE(a.contains(IntVec3{4, 2, 1}));
  EXPECT_TRUE(a.grown({1, 1, 1}).contains(a));
  EXPECT_FALSE(a.contains(b));
  EXPECT_EQ(a.grown(1, 2, 3), (IndexBox{{0, -2, 0}, {4, 6, 2}}));
}

TEST(IndexBox, VisitsEveryCellOnceXFastest) {
  std::vector<IntVec3> cells;
  for_each_cell({{1, 2, 3}, {3, 4, 4}}, [&](IntVec3 c) { cells.push_back(c); });
  EXPECT_EQ(cells, (std::vector<IntVec3>{{1, 2, 3}, {2, 2, 3}, {1, 3, 3}, {2, 3, 3}}));
}

TEST(Side, NamesAndDirections) {
  EXPECT_EQ(name_of(Side::y_plus), "y+");
  EXPECT_EQ(direction_of(Side::z_minus), 2);
  EXPECT_FALSE(is_plus(Side::z_minus));
  for (Side s : all_sides) EXPECT_EQ(side_of(direction_of(s), is_plus(s)), s);
}

TEST(Level, CentresAndGhosts) {
  Level level;
  level.anchor = {-1, 0, 0};
  level.spacing = {0.5, 1, 2};
  level.active = {true, false, true};
  EXPECT_EQ(level.centre({0, 0, 1}), (Vec3{-0.75, 0.5, 3}));
  EXPECT_EQ(level.cell_volume(), 1);
  EXPECT_EQ(level.ghosts(3), (IntVec3{3, 0, 3}));
  EXPECT_EQ(level.active_count(), 2);
}

TEST(Split, CutsInIntegerArithmeticZFastest) {
  const std::vector<IndexBox> boxes = split({{10, 0, 0}, {17, 4, 1}}, {3, 2, 1});
  ASSERT_EQ(boxes.size(), 6u);
  EXPECT_EQ(boxes[0], (IndexBox{{10, 0, 0}, {12, 2, 1}}));
  EXPECT_EQ(boxes[1], (IndexBox{{10, 2, 0}, {12, 4, 1}}));
  EXPECT_EQ(boxes[5], (IndexBox{{14, 2, 0}, {17, 4, 1}}));
}

std::vector<GridBox> boxes_of(const std::vector<IndexBox>& cells) {
  std::vector<GridBox> boxes;
  for (const IndexBox& c : cells) boxes.push_back({c, -1, static_cast<int>(boxes.size())});
  return boxes;
}

std::vector<std::int64_t> loads(const std::vector<GridBox>& boxes, int ranks) {
  std::vector<std::int64_t> load(ranks, 0);
  for (const GridBox& b : boxes) load.at(b.owner) += b.cells.volume();
  return load;
}

TEST(AssignOwners, SharesCellsEvenly) {
  std::vector<GridBox> boxes = boxes_of(split({{0, 0, 0}, {64, 64, 8}}, {8, 8, 1}));
  for (int ranks : {1, 2, 3, 5, 8, 13, 64}) {
    assign_owners(boxes, ranks);
    for (std::int64_t cells : loads(boxes, ranks)) {
      EXPECT_GT(cells, 0);
      EXPECT_LE(cells, 64 * 64 * 8 / ranks + 512) << ranks;  // the mean and one box
    }
  }
}

TEST(AssignOwners, ABigBoxLeavesNoRankEmpty) {
  std::vector<IndexBox> cells = {{{0, 0, 0}, {100, 100, 1}}};
  for (int i = 0; i < 4; ++i) cells.push_back({{100 + i, 0, 0}, {101 + i, 1, 1}});
  std::vector<GridBox> boxes = boxes_of(cells);
  for (int ranks = 1; ranks <= 5; ++ranks) {
    assign_owners(boxes, ranks);
    for (std::int64_t n : loads(boxes, ranks)) EXPECT_GT(n, 0) << ranks;
  }
  assign_owners(boxes, 9);  // more ranks than boxes: some stay without, none is out of range
  EXPECT_EQ(loads(boxes, 9).size(), 9u);
}

TEST(AssignOwners, SharesCostEvenly) {
  std::vector<GridBox> boxes = boxes_of(split({{0, 0, 0}, {64, 64, 1}}, {16, 16, 1}));
  std::vector<double> costs;
  double total = 0;
  for (const GridBox& b : boxes) {  // a hot corner
    costs.push_back(1e-6 * (b.cells.lower.x < 16 && b.cells.lower.y < 16 ? 20 : 1));
    total += costs.back();
  }
  for (const int ranks : {1, 2, 3, 7, 16}) {
    assign_owners(boxes, ranks);
    const double by_cells = imbalance(boxes, costs, ranks);
    assign_owners(boxes, costs, ranks);
    const double by_cost = imbalance(boxes, costs, ranks);
    EXPECT_LE(by_cost, 1 + 20e-6 * ranks / total) << ranks;  // the mean and one box
    EXPECT_TRUE(ranks == 1 || by_cost < by_cells) << ranks;
    for (const std::int64_t cells : loads(boxes, ranks)) EXPECT_GT(cells, 0);
  }
}

TEST(AssignOwners, WithoutCostsCellsDecide) {
  std::vector<GridBox> by_cells = boxes_of(split({{0, 0, 0}, {60, 30, 1}}, {6, 5, 1}));
  std::vector<GridBox> boxes = by_cells;
  assign_owners(by_cells, 4);
  for (const std::vector<double>& costs :
       {std::vector<double>(30, 0.0), std::vector<double>(30, 7.0), std::vector<double>{}}) {
    assign_owners(boxes, costs, 4);
    for (std::size_t b = 0; b < boxes.size(); ++b) EXPECT_EQ(boxes[b].owner, by_cells[b].owner);
  }
  std::vector<GridBox> none;
  assign_owners(none, std::vector<double>{}, 4);
  EXPECT_EQ(imbalance(boxes, std::vector<double>(30, 0.0), 4), 1);
}

}  // namespace
}  // namespace sluice::level_test
