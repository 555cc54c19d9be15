// Sets of cells as boxes, against counting cell by cell.
#include "framework/grid/box_list.hpp"

#include <gtest/gtest.h>

#include <random>
#include <set>

namespace sluice::box_list_test {
namespace {

using Key = std::array<int, 3>;

std::set<Key> cells_of(const std::vector<IndexBox>& boxes) {
  std::set<Key> cells;
  std::int64_t count = 0;
  for (const IndexBox& b : boxes) {
    for_each_cell(b, [&](IntVec3 c) { cells.insert({c.x, c.y, c.z}); });
    count += b.volume();
  }
  EXPECT_EQ(count, static_cast<std::int64_t>(cells.size())) << "pieces overlap";
  return cells;
}

TEST(BoxList, coarsening_rounds_down_and_boxes_outward) {
  EXPECT_EQ(coarsen(IntVec3{-1, 4, 7}, {4, 4, 4}), (IntVec3{-1, 1, 1}));
  EXPECT_EQ(coarsen(IntVec3{-4, -5, 0}, {4, 4, 1}), (IntVec3{-1, -2, 0}));
  EXPECT_EQ(coarsen(IndexBox{{1, -3, 0}, {5, 8, 1}}, {2, 4, 1}), (IndexBox{{0, -1, 0}, {3, 2, 1}}));
  EXPECT_EQ(refine(IndexBox{{-1, 0, 0}, {2, 3, 1}}, {2, 4, 1}), (IndexBox{{-2, 0, 0}, {4, 12, 1}}));
}

TEST(BoxList, what_is_left_is_every_other_cell_once) {
  std::mt19937 random(7);
  auto any = [&](int low, int high) { return std::uniform_int_distribution(low, high)(random); };
  auto box = [&] {
    const IntVec3 low{any(-4, 4), any(-4, 4), any(-4, 4)};
    return IndexBox{low, low + IntVec3{any(1, 6), any(1, 6), any(1, 6)}};
  };
  for (int n = 0; n < 200; ++n) {
    const IndexBox whole = box();
    std::vector<IndexBox> holes;
    for (int h = 0; h < 5; ++h) holes.push_back(box());
    const std::set<Key> left = cells_of(BoxFinder(holes).uncovered(whole));
    for_each_cell(whole, [&](IntVec3 c) {
      bool covered = false;
      for (const IndexBox& h : holes) covered = covered || h.contains(c);
      EXPECT_EQ(left.count({c.x, c.y, c.z}), covered ? 0u : 1u);
    });
  }
}

TEST(BoxList, a_finder_names_the_same_boxes_as_asking_all) {
  std::mt19937 random(11);
  auto any = [&](int low, int high) { return std::uniform_int_distribution(low, high)(random); };
  std::vector<IndexBox> boxes;
  for (int n = 0; n < 60; ++n) {
    const IntVec3 low{any(-40, 40), any(-40, 40), 0};
    boxes.push_back({low, low + IntVec3{any(1, 20), any(1, 20), 1}});
  }
  const BoxFinder finder(boxes);
  for (int n = 0; n < 200; ++n) {
    const IntVec3 low{any(-60, 60), any(-60, 60), any(-1, 0)};
    const IndexBox region{low, low + IntVec3{any(1, 30), any(1, 30), any(1, 2)}};
    std::vector<int> expected;
    for (std::size_t m = 0; m < boxes.size(); ++m)
      if (!intersection(boxes[m], region).empty()) expected.push_back(static_cast<int>(m));
    EXPECT_EQ(finder.overlapping(region), expected);
  }
  EXPECT_TRUE(BoxFinder({}).overlapping({{0, 0, 0}, {1, 1, 1}}).empty());
}

}  // namespace
}  // namespace sluice::box_list_test
