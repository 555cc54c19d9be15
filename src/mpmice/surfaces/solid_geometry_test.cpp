// Cells that solids close: pockets that are kept open, sides of the domain.
#include "mpmice/surfaces/solid_geometry.hpp"

#include <gtest/gtest.h>

#include "mpmice/test_support/block_in_cells.hpp"

namespace sluice::mpmice::solid_geometry_test {
namespace {

SolidGeometry<1> geometry(const NearCells<1>& near, double theta) {
  SolidGeometry<1> solid;
  for (Column* column : {&solid.theta, &solid.theta_next}) column->assign(near.size(), theta);
  for (auto* columns : {&solid.covered, &solid.covered_next, &solid.mean_covered, &solid.swept})
    (*columns)[0].assign(near.size(), theta);
  return solid;
}

TEST(SolidGeometry, APocketWithoutAWayOutStaysOpen) {
  const BlockInCells<1> block(16, 1, 6, 8);
  const std::size_t pocket = block.near.frame().cells.index({7}),
                    beside = block.near.frame().cells.index({8});
  for (const double next : {1.0, 0.5}) {
    SolidGeometry<1> solid = geometry(block.near, 1);
    solid.theta[pocket] = 0.2;  // closes in the step
    solid.theta_next[beside] = next;
    keep_pockets(block.near, solid);
    EXPECT_EQ(solid.theta_next[pocket], next < 1 ? 1.0 : 1 - 1e-3);
  }
}

// A cell that held less than that keeps what it held.
TEST(SolidGeometry, APocketDoesNotGrow) {
  const BlockInCells<1> block(16, 1, 6, 8);
  const std::size_t pocket = block.near.frame().cells.index({7});
  SolidGeometry<1> solid = geometry(block.near, 1);
  solid.theta[pocket] = 1 - 1e-5;
  keep_pockets(block.near, solid);
  EXPECT_EQ(solid.theta_next[pocket], 1 - (1 - solid.theta[pocket]));
}

TEST(SolidGeometry, ACellAtACoveredSideHasNoOpenFaces) {
  const BlockInCells<1> block(16, 1, 0, 2);
  const auto at = [&](int i) { return block.near.frame().cells.index({i}); };
  SolidGeometry<1> solid = geometry(block.near, 1);
  for (auto* of : {&solid.covered, &solid.covered_next, &solid.mean_covered}) (*of)[0][at(1)] = 0;
  close_cells_at_sides(block.near, solid);
  EXPECT_EQ(solid.mean_covered[0][at(1)], 1);
  // Not where the side is open for a part of the step.
  for (auto* of : {&solid.covered, &solid.covered_next, &solid.mean_covered}) (*of)[0][at(1)] = 0;
  solid.mean_covered[0][at(0)] = 0.5;
  close_cells_at_sides(block.near, solid);
  EXPECT_EQ(solid.mean_covered[0][at(1)], 0);
}

}  // namespace
}  // namespace sluice::mpmice::solid_geometry_test
