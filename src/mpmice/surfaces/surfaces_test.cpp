// Surfaces of a block of particles: where it lies in cells, what it sweeps, means over it.
#include "mpmice/surfaces/surfaces.hpp"

#include <gtest/gtest.h>

#include "mpmice/test_support/block_in_cells.hpp"

namespace sluice::mpmice::surfaces_of_block {
namespace {

TEST(Surfaces, ABlockLiesWhereItsCornersAre) {
  BlockInCells<2> block(16, 0.5, 5.25, 8.5);
  block.find_surfaces();
  const SolidGeometry<2>& solid = block.surfaces.solid();
  EXPECT_NEAR(solid.theta[block.at({5, 5})], 0.75 * 0.75, 1e-15);
  EXPECT_NEAR(solid.theta[block.at({6, 5})], 0.75, 1e-15);
  EXPECT_EQ(solid.theta[block.at({6, 6})], 1);
  EXPECT_NEAR(solid.theta[block.at({8, 8})], 0.25, 1e-15);
  EXPECT_EQ(solid.theta[block.at({4, 6})], 0);
  EXPECT_NEAR(solid.covered[0][block.at({6, 8})], 0.5, 1e-15);
  EXPECT_NEAR(solid.normal[1][block.at({6, 5})], -1, 1e-15);
}

// It passes faces by as much as it moves.
TEST(Surfaces, WhatMovesSweepsItsWay) {
  const double way = 0.125;
  BlockInCells<1> block(16, 2, 5.25, 8.5, way);
  block.find_surfaces();
  block.find_moved();
  const SolidGeometry<1>& solid = block.surfaces.solid();
  EXPECT_NEAR(solid.theta_next[block.at({5})], 0.75 - way, 1e-15);
  EXPECT_NEAR(solid.theta_next[block.at({8})], 0.5 + way, 1e-15);
  // theta' - theta = q + C(lower) - C(upper), q: what the surface in the cell adds itself.
  for (int i = 4; i < 10; ++i) EXPECT_EQ(solid.swept[0][block.at({i})], 0) << i;
}

TEST(SurfaceMeans, AreThoseOfTheParticlesBehind) {
  BlockInCells<2> block(16, 0.5, 5.25, 8.5, 0, false, true, 2000);
  const solids::ParticleColumns& c = block.columns();
  block.give(c.velocity, 3);
  block.give(c.velocity + 1, -4);
  block.give(c.stress, -5e6);      // xx
  block.give(c.stress + 1, -2e6);  // yy
  block.solids.waves = 1000 / 0.5;
  block.find_surfaces();
  const OnSurfaces<2>& on = block.surfaces.on();
  const std::size_t below = block.at({7, 5}), left = block.at({5, 7}), corner = block.at({5, 5});
  EXPECT_NEAR(on.area[below], 1, 1e-14);
  EXPECT_NEAR(on.area[corner], 1.5, 1e-14);
  for (const std::size_t i : {below, left, corner}) {
    EXPECT_NEAR(on.velocity[0][i], 3, 1e-13);
    EXPECT_NEAR(on.velocity[1][i], -4, 1e-13);
    EXPECT_NEAR(on.inverse_density[i] * 2000, 1, 1e-13);
    // Sums count in 2^-56, of values from 5e-7 up.
    EXPECT_NEAR(on.compliance[i] * 2000 * 1000, 1, 2 * 0x1p-56 / 5e-7);
  }
  EXPECT_NEAR(on.pressure[below], 2e6, 1e-6);
  EXPECT_NEAR(on.pressure[left], 5e6, 1e-6);
  EXPECT_NEAR(on.pressure[corner], 3.5e6, 1e-6);
  EXPECT_NEAR(on.place[0][left], 0.25, 1e-14);
  EXPECT_NEAR(on.place[1][left], 0.5, 1e-14);
}

// A rule that prescribes a velocity is asked, whatever particles have; rigid solids do not give
// way.
TEST(SurfaceMeans, ObeyWhatIsPrescribed) {
  BlockInCells<2> block(16, 0.5, 5.25, 8.5, 0, true);
  block.solids.waves = 1000;
  block.solids.prescribed = Vec3{7, 0, 0};
  block.find_surfaces();
  const std::size_t left = block.at({5, 7});
  EXPECT_NEAR(block.surfaces.on().velocity[0][left], 7, 1e-13);
  EXPECT_EQ(block.surfaces.on().compliance[left], 0);
}

// What goes farther than the arrays reach counts as at rest, and says so.
TEST(Surfaces, WhatStraysCountsAsAtRest) {
  for (const double way : {0.5, 1.5}) {
    BlockInCells<1> block(16, 2, 5.25, 8.5, way);
    block.find_surfaces();
    block.find_moved();
    const bool strays = way > Frame<1>::slow_move;
    EXPECT_EQ(block.sets.strayed(), strays);
    EXPECT_NEAR(block.surfaces.solid().theta_next[block.at({8})], strays ? 0.5 : 1, 1e-15);
  }
}

}  // namespace
}  // namespace sluice::mpmice::surfaces_of_block
