// Regions searched and filled row by row, whichever directions are active.
#include "framework/field/array_view.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "framework/field/warehouse.hpp"

namespace sluice::array_view_test {
namespace {

struct Field {
  std::vector<double> numbers;
  RealView view;

  explicit Field(IntVec3 cells) {
    Level level;
    for (int d = 0; d < 3; ++d) level.active[d] = cells[d] > 1;
    const IndexBox box{{-1, 2, 0}, IntVec3{-1, 2, 0} + cells};
    numbers.assign(box.volume(), 0.0);
    view = lay_out(numbers.data(), box, level);
  }
};

class RegionsOnShapes : public testing::TestWithParam<IntVec3> {};

TEST_P(RegionsOnShapes, FindsEveryCellThatDiffersAndNoneBeyond) {
  Field f(GetParam());
  IndexBox region = f.view.box;
  for (int d = 0; d < 3; ++d)
    if (region.size()[d] > 2) {
      region.lower[d] += 1;
      region.upper[d] -= 1;
    }
  for_each_cell(f.view.box, [&](IntVec3 c) {
    f.view(c) = 3;
    EXPECT_EQ(any_other(f.view, region, 0), region.contains(c)) << c.x << ' ' << c.y << ' ' << c.z;
    f.view(c) = 0;
  });
  EXPECT_TRUE(any_other(f.view, region, 1));
  EXPECT_FALSE(any_other(f.view, {region.lower, region.lower}, 1));  // nothing there
}

TEST_P(RegionsOnShapes, FillsTheRegionOnly) {
  Field f(GetParam());
  IndexBox region = f.view.box;
  for (int d = 0; d < 3; ++d)
    if (region.size()[d] > 1) region.upper[d] -= 1;
  f.view(region.lower) = 7;
  fill_where_different(f.view, region, 1);
  for_each_cell(f.view.box,
                [&](IntVec3 c) { EXPECT_EQ(f.view(c), region.contains(c) ? 1.0 : 0.0); });
}

INSTANTIATE_TEST_SUITE_P(Shapes, RegionsOnShapes,
                         testing::Values(IntVec3{9, 1, 1}, IntVec3{1, 9, 1}, IntVec3{1, 1, 9},
                                         IntVec3{7, 5, 1}, IntVec3{1, 4, 6}, IntVec3{5, 1, 4},
                                         IntVec3{5, 4, 6}));

TEST(Regions, ANanDiffersAndTheSignOfZeroDoesNot) {
  Field f({8, 1, 1});
  f.view(3, 2, 0) = -0.0;
  EXPECT_FALSE(any_other(f.view, f.view.box, 0));
  f.view(3, 2, 0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(any_other(f.view, f.view.box, 0));
  fill_where_different(f.view, f.view.box, 0);
  EXPECT_FALSE(any_other(f.view, f.view.box, 0));
}

}  // namespace
}  // namespace sluice::array_view_test
