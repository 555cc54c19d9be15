// Directions of surfaces: planes, corners, whatever the place in the cell.
#include "mpmice/walls/smooth_normals.hpp"

#include <gtest/gtest.h>

#include "mpmice/test_support/block_in_cells.hpp"

namespace sluice::mpmice::smooth_normals_test {
namespace {

TEST(SmoothNormals, AreThoseOfPlanesAndCorners) {
  BlockInCells<2> block(24, 0.5, 5.25, 12.5);
  block.find_surfaces();
  SmoothNormals<2> normals;
  normals.find(block.near, block.surfaces.solid(), block.surfaces.on());
  const std::size_t left = block.at({5, 8}), corner = block.at({5, 5});
  EXPECT_LT(normals.along(0, left), 0);
  EXPECT_NEAR(normals.along(1, left), 0, 1e-14);
  EXPECT_EQ(normals.largest(left), 0u);
  EXPECT_NEAR(normals.along(0, corner), normals.along(1, corner), 1e-14);
  // Along a diagonal sqrt(2) cells lie in a length of one, along an axis one.
  const Frame<2>& frame = block.near.frame();
  EXPECT_NEAR(normals.cells_along(frame, left, normals.length(left)), 1 / 0.5, 1e-13);
  EXPECT_NEAR(normals.cells_along(frame, corner, normals.length(corner)), std::sqrt(2) / 0.5,
              1e-13);
  EXPECT_NEAR(most_cells_in_a_length(frame), 2 / 0.5, 1e-13);
  EXPECT_EQ(normals.length(block.at({8, 8})), 0);  // no surface
}

}  // namespace
}  // namespace sluice::mpmice::smooth_normals_test
