// Mass and velocity of a moving block in the cells beside fluid.
#include "mpmice/surfaces/mean_motion.hpp"

#include <gtest/gtest.h>

#include "mpmice/test_support/block_in_cells.hpp"

namespace sluice::mpmice::mean_motion_test {
namespace {

TEST(MeanMotion, KeepsMassAndHasTheVelocityOfTheStep) {
  const double h = 0.5, way = 0.125, dt = 1e-3, rho = 1500;
  BlockInCells<2> block(16, h, 5.25, 8.5, way, false, false, rho);
  block.find_surfaces();
  block.find_moved();
  block.solids.mass = rho * h * h * h;
  block.solids.way = way;
  MeanMotion<2> motion(block.solids, true);
  motion.find(block.near, block.surfaces.solid(), block.sets, dt, world());
  double mass = 0;
  block.near.for_each([&](const Cell<2>&, std::size_t i) {
    mass += motion.mass()[i] * h * h * h;
    if (motion.mass()[i] > 0) {
      EXPECT_NEAR(motion.velocity(0)[i] * dt / (way * h), 1, 1e-12);
      EXPECT_EQ(motion.velocity(1)[i], 0);
    }
  });
  EXPECT_NEAR(mass / (rho * 3.25 * 3.25 * h * h * h), 1, 1e-12);
  // Between cells that keep fluid faces have none of it.
  const Column faces = motion.at_faces(0, block.near, block.surfaces.solid());
  EXPECT_NEAR(faces[block.at({7, 7})] * dt / (way * h), 1, 1e-12);
  EXPECT_EQ(faces[block.at({5, 7})], 0);
}

}  // namespace
}  // namespace sluice::mpmice::mean_motion_test
