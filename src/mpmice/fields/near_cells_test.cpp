// The cells near solids: how many, whose they are, what lies around one.
#include "mpmice/fields/near_cells.hpp"

#include <gtest/gtest.h>

#include "mpmice/test_support/block_in_cells.hpp"

namespace sluice::mpmice::near_cells_test {
namespace {

NearCells<2>& around(NearCells<2>& near, const Level& level, const CellBox<2>& solid) {
  near.begin().add(solid);
  near.finish(level, level.boxes, world());
  return near;
}

TEST(NearCells, AllCellsOfTheOnlyRankAreItsOwn) {
  const Level level = level_of<2>(64, 0.5);
  NearCells<2> cells(level);
  const NearCells<2>& near = around(cells, level, {{30, 30}, {32, 32}});
  int all = 0, own = 0, within = 0;
  near.for_each([&](const Cell<2>&, std::size_t) { ++all; });
  near.for_each_own([&](const Cell<2>&, std::size_t) { ++own; });
  near.for_each_within(0, [&](const Cell<2>&, std::size_t) { ++within; });
  EXPECT_GE(all, (2 + 2 * Frame<2>::reach) * (2 + 2 * Frame<2>::reach));
  EXPECT_LT(all, 64 * 64 / 4);
  EXPECT_EQ(own, all);
  EXPECT_EQ(within, all);
  EXPECT_EQ(near.sharers(), nullptr);
}

// At a corner of the domain half of what is around lies beyond it, unless sides are periodic.
TEST(NearCells, NeighboursEndAtSidesOfTheDomain) {
  for (const bool periodic : {false, true}) {
    const Level level = level_of<2>(16, 1, periodic);
    NearCells<2> cells(level);
    const NearCells<2>& near = around(cells, level, {{0, 0}, {2, 2}});
    int beside = 0, around_it = 0, offsets = 0;
    near.for_each_neighbour({0, 0}, [&](std::size_t) { ++beside; });
    near.for_each_around({0, 0}, 1, [&](std::size_t) { ++around_it; });
    near.for_each_offset({0, 0}, 1, [&](std::size_t, const std::array<int, 2>& offset) {
      offsets += offset[0] + 10 * offset[1];
    });
    EXPECT_EQ(beside, periodic ? 4 : 2);
    EXPECT_EQ(around_it, periodic ? 9 : 4);
    EXPECT_EQ(offsets, periodic ? 0 : 22);
  }
}

}  // namespace
}  // namespace sluice::mpmice::near_cells_test
