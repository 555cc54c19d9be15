// Laws of the wall: what they return satisfies them.
#include "ice/transport/wall_shear.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace sluice::ice::wall_shear_test {
namespace {

TEST(WallShear, RoughWallFollowsTheLogarithmicLaw) {
  const WallShear rough{Side::y_minus, false, 0.002, 0.4, {}};
  for (const double y : {0.01, 0.1, 3.0}) {
    const double u_tau = friction_velocity(rough, 2.5, y, 0);
    EXPECT_NEAR(u_tau * std::log(y / 0.002) / 0.4, 2.5, 1e-14);
  }
  EXPECT_EQ(friction_velocity(rough, 0, 0.1, 0), 0);
}

TEST(WallShear, SmoothWallIsLaminarBelowAndLogarithmicAbove) {
  const WallShear smooth{Side::y_minus, true, 0, 0.4, {}};
  constexpr double nu = 1e-5, y = 0.01;
  for (const double speed : {1e-4, 1e-2, 0.1}) {  // y+ = 0.3, 3, 10
    const double u_tau = friction_velocity(smooth, speed, y, nu);
    EXPECT_NEAR(u_tau * u_tau * y / (nu * speed), 1, 1e-14);
  }
  for (const double speed : {0.2, 1.0, 30.0, 1e5}) {
    const double u_tau = friction_velocity(smooth, speed, y, nu);
    EXPECT_NEAR(u_tau * (std::log(y * u_tau / nu) / 0.4 + 5.2) / speed, 1, 1e-13) << speed;
  }
  EXPECT_EQ(friction_velocity(smooth, 1, y, 0), 0);
}

// Faster flow is dragged more, also where one law takes over from the other.
TEST(WallShear, SmoothWallRisesEverywhere) {
  const WallShear smooth{Side::x_plus, true, 0, 0.41, {}};
  double before = 0;
  for (double speed = 1e-3; speed < 1e3; speed *= 1.01) {
    const double u_tau = friction_velocity(smooth, speed, 0.02, 1e-4);
    EXPECT_GT(u_tau, before);
    EXPECT_LT(u_tau, before == 0 ? 1 : 1.02 * before);
    before = u_tau;
  }
}

TEST(SpongeLayer, HoldsTheCellsWhoseCentresLieInItsBoxes) {
  ViscosityModels models;
  models.sponges.push_back({{{{0.1, -9, -9}, {0.35, 9, 9}}, {{-1e30, 0, 0}, {1e30, 0.1, 1}}}, 3.0});
  Level level;
  level.anchor = {-1, 0, 0};
  level.spacing = {0.1, 0.05, 1};
  const auto cells = sponge_cells(models, level);
  ASSERT_EQ(cells.size(), 2u);
  // Centres at -0.95, -0.85, ...: 0.15 is that of cell 11, 0.35 of cell 13 or just above.
  EXPECT_EQ(cells[0].cells.lower.x, 11);
  EXPECT_GE(cells[0].cells.upper.x, 13);
  EXPECT_LE(cells[0].cells.upper.x, 14);
  EXPECT_LT(cells[1].cells.lower.x, -1000000);
  EXPECT_GT(cells[1].cells.upper.x, 1000000);
  EXPECT_EQ(cells[1].cells.lower.y, 0);
  EXPECT_EQ(cells[1].cells.upper.y, 2);
  EXPECT_EQ(cells[1].viscosity, 3.0);
}

}  // namespace
}  // namespace sluice::ice::wall_shear_test
