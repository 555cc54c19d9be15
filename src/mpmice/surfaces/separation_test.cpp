// Particles that let their neighbours go: what a block keeps, who knows of it, who leaves.
#include "mpmice/surfaces/separation.hpp"

#include <gtest/gtest.h>

#include "framework/run/levels/level_solver.hpp"
#include "mpmice/test_support/block_in_cells.hpp"

namespace sluice::mpmice::separation_test {
namespace {

class SeparationOfBlock : public ::testing::Test {
 protected:
  StageScope scope() {
    StageScope of;
    of.ranks = &world();
    of.journal = &journal_;
    return of;
  }
  StepJournal journal_;
};

TEST_F(SeparationOfBlock, NothingPartsThatIsNotDrawnOut) {
  BlockInCells<2> block(16, 1, 5, 8);
  block.solids.extent = 0.5;
  EXPECT_FALSE(Separation<2>(block.solids).part(scope(), block.near, block.sets));
  block.solids.extent = 1;  // might, but does not
  EXPECT_FALSE(Separation<2>(block.solids).part(scope(), block.near, block.sets));
}

// One whose middle has left the domain is dropped, and its neighbours have outer faces there.
TEST_F(SeparationOfBlock, WhatLeavesOpensTheFacesOfItsNeighbours) {
  BlockInCells<2> block(16, 1, 0, 2);
  for (std::size_t p = 0; p < block.next.size(); ++p) {
    Vec3 place = block.next.position(p);
    place[0] -= 0.75;
    block.next.move_to(p, place);
    for (int k = 0; k < 4; ++k)
      block.next.column(static_cast<std::size_t>(block.columns().corners + 3 * k))[p] -= 0.75;
  }
  block.solids.left = true;
  ASSERT_TRUE(Separation<2>(block.solids).part(scope(), block.near, block.sets));
  const SolidSet<2>& s = block.sets.all().front();
  for (std::size_t p = 0; p < 4; ++p) {
    const bool leaves = block.set.position(p)[0] < 1;
    EXPECT_EQ(s.dropped[p] != 0, leaves) << p;
    if (!leaves) {
      EXPECT_EQ(s.parted[p], 1) << p;  // the low face along x
    }
  }
  journal_.accept();
  for (std::size_t p = 0; p < 4; ++p)
    if (block.set.position(p)[0] > 1) {
      EXPECT_NE(static_cast<int>(block.set.column(6)[p]) & 1, 0) << p;
    }
}

}  // namespace
}  // namespace sluice::mpmice::separation_test
