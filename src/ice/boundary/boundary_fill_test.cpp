// Ghost states from boundary conditions, in one and two dimensions, with walls, inflow and gravity.
#include "ice/boundary/boundary_fill.hpp"

#include <gtest/gtest.h>

#include <memory>

#include "ice/fluid/labels.hpp"
#include "ice/test_support/conditions.hpp"

namespace sluice::ice::boundary_fill_test {
namespace {

BoundaryRegion whole_side(std::vector<Condition> conditions) {
  BoundaryRegion region;
  region.conditions = std::move(conditions);
  return region;
}

// A tube of eight cells along x with the same region on both ends, rho = i + 1, u = 2, p = 10.
class Tube {
 public:
  explicit Tube(const BoundaryRegion& region, double gravity = 0, double viscosity = 0) {
    Level level;
    level.domain = {{0, 0, 0}, {8, 1, 1}};
    level.active = {true, false, false};
    level.boxes = {{level.domain, 0, 0}};
    scene_.grid.levels = {level};
    scene_.constants.gravity = {gravity, 0, 0};
    for (Side side : {Side::x_minus, Side::x_plus})
      scene_.boundary.sides[index_of(side)].regions = {region};
    material_.viscosity = viscosity;
    const Labels& l = labels();
    state_ = std::make_unique<Warehouse>(scene_.grid.levels.front(), 0);
    state_->add({l.mass, 0, 1, 3});
    state_->add({l.momentum, 0, 2, 3});
    state_->add({l.energy, 0, 1, 3});
    for (int i = 0; i < 8; ++i) {
      state_->view(0, 0, 0)(i, 0, 0) = i + 1;
      state_->view(1, 0, 0)(i, 0, 0) = 2.0 * (i + 1);
      state_->view(1, 1, 0)(i, 0, 0) = 0.5 * (i + 1);
      state_->view(2, 0, 0)(i, 0, 0) = 10.0 / 0.4;
    }
    BoundaryFill(scene_, material_, {l.mass, l.momentum, l.energy, 0, {0, 1}})
        .fill(*state_, ThreadTeam());
  }
  double rho(int i) const { return state_->view(0, 0, 0)(i, 0, 0); }
  double u(int i, int c = 0) const { return state_->view(1, c, 0)(i, 0, 0) / rho(i); }
  double p(int i) const { return 0.4 * state_->view(2, 0, 0)(i, 0, 0); }

 private:
  Scene scene_;
  IceMaterial material_;
  std::unique_ptr<Warehouse> state_;
};

BoundaryRegion symmetric() {
  return whole_side({condition("Symmetric", ConditionKind::symmetry)});
}

TEST(BoundaryFill, SymmetryMirrorsTheStateAndTurnsTheNormalVelocity) {
  const Tube tube(symmetric());
  for (int layer = 0; layer < 3; ++layer) {
    EXPECT_EQ(tube.rho(-1 - layer), tube.rho(layer));
    EXPECT_EQ(tube.u(-1 - layer), -2.0);
    EXPECT_EQ(tube.u(-1 - layer, 1), 0.5);
    EXPECT_EQ(tube.rho(8 + layer), tube.rho(7 - layer));
    EXPECT_EQ(tube.u(8 + layer), -2.0);
  }
}

TEST(BoundaryFill, ZeroGradientCopiesTheNearestCell) {
  const Tube tube(whole_side(
      {condition("Pressure", ConditionKind::neumann), condition("Density", ConditionKind::neumann),
       condition("Temperature", ConditionKind::neumann), velocity(ConditionKind::neumann, {})}));
  for (int layer = 0; layer < 3; ++layer) {
    EXPECT_EQ(tube.rho(-1 - layer), 1.0);
    EXPECT_EQ(tube.u(-1 - layer), 2.0);
    EXPECT_EQ(tube.rho(8 + layer), 8.0);
    EXPECT_EQ(tube.p(8 + layer), tube.p(7));
  }
}

TEST(BoundaryFill, AGradientIsTakenAlongTheInwardNormal) {
  const Tube tube(whole_side({condition("Pressure", ConditionKind::neumann),
                              condition("Density", ConditionKind::neumann, -0.25),
                              velocity(ConditionKind::neumann, {})}));
  EXPECT_DOUBLE_EQ(tube.rho(-1), 1.25);
  EXPECT_DOUBLE_EQ(tube.rho(-3), 1.75);
  EXPECT_DOUBLE_EQ(tube.rho(9), 8.5);
}

TEST(BoundaryFill, AVelocityWithoutNormalPartIsAWall) {
  const std::vector<Condition> wall = {condition("Pressure", ConditionKind::neumann),
                                       condition("Density", ConditionKind::neumann),
                                       velocity(ConditionKind::dirichlet, {0, 3, 0})};
  const Tube slippery(whole_side(wall));
  EXPECT_DOUBLE_EQ(slippery.u(-1), -2.0);
  EXPECT_DOUBLE_EQ(slippery.u(-1, 1), 0.5);
  EXPECT_DOUBLE_EQ(slippery.rho(-2), 2.0);
  const Tube viscous(whole_side(wall), 0, 0.1);
  EXPECT_DOUBLE_EQ(viscous.u(-1, 1), 2 * 3 - 0.5);  // the mean on the wall is the wall's
}

TEST(BoundaryFill, InflowIsPrescribed) {
  const Tube tube(whole_side({condition("Pressure", ConditionKind::neumann),
                              condition("Density", ConditionKind::dirichlet, 4),
                              condition("Temperature", ConditionKind::dirichlet, 5),
                              velocity(ConditionKind::dirichlet, {7, 0, 0})}));
  EXPECT_DOUBLE_EQ(tube.rho(-3), 4.0);
  EXPECT_DOUBLE_EQ(tube.u(-3), 7.0);
  EXPECT_DOUBLE_EQ(tube.p(-3), 0.4 * 4 * 5);
}

TEST(BoundaryFill, OutletPressureWithTemperatureGivesTheDensity) {
  const Tube tube(whole_side({condition("Pressure", ConditionKind::dirichlet, 8),
                              condition("Density", ConditionKind::neumann),
                              condition("Temperature", ConditionKind::dirichlet, 5),
                              velocity(ConditionKind::neumann, {})}));
  EXPECT_DOUBLE_EQ(tube.p(8), 8.0);
  EXPECT_DOUBLE_EQ(tube.rho(8), 8.0 / (0.4 * 5));
  EXPECT_DOUBLE_EQ(tube.u(8), 2.0);
}

TEST(BoundaryFill, UnderGravityTheWallPressureContinuesTheDiscreteBalance) {
  const double g = -1;
  const Tube tube(symmetric(), g);
  // p_{i+1} - p_i = g dx (rho_i + rho_{i+1})/2 across the wall, with mirrored densities.
  EXPECT_DOUBLE_EQ(tube.p(0) - tube.p(-1), g * tube.rho(0));
  EXPECT_DOUBLE_EQ(tube.p(8) - tube.p(7), g * tube.rho(7));
}

TEST(BoundaryFill, AColumnHeavierThanItsPressureLeavesATenthOfIt) {
  // On either wall, whichever way the weight acts: p = 10, and g rho dx is 24 above, 12 below.
  EXPECT_DOUBLE_EQ(Tube(symmetric(), -3).p(8), 1.0);
  EXPECT_DOUBLE_EQ(Tube(symmetric(), -3).p(10), 1.0);
  EXPECT_DOUBLE_EQ(Tube(symmetric(), 12).p(-1), 1.0);
  EXPECT_DOUBLE_EQ(Tube(symmetric(), 12).p(-3), 1.0);
}

TEST(BoundaryFill, ASpecificVolumeMustBeThatOfTheDensity) {
  const std::vector<Condition> inflow = {condition("Density", ConditionKind::dirichlet, 4),
                                         condition("Temperature", ConditionKind::dirichlet, 5),
                                         velocity(ConditionKind::dirichlet, {7, 0, 0})};
  std::vector<Condition> with = inflow;
  with.push_back(condition("SpecificVol", ConditionKind::dirichlet, 0.25));
  const Tube tube(whole_side(with));
  EXPECT_DOUBLE_EQ(tube.rho(-3), 4.0);
  with.back() = condition("SpecificVol", ConditionKind::compute_from_density, 0);
  EXPECT_DOUBLE_EQ(Tube(whole_side(with)).p(-3), tube.p(-3));
  with.back() = condition("SpecificVol", ConditionKind::dirichlet, 0.3);
  EXPECT_THROW(Tube{whole_side(with)}, InputError);
}

TEST(BoundaryFill, AConditionThatIsNotBuiltIsRefusedByName) {
  Condition slip = condition("Pressure", ConditionKind::other);
  slip.kind_name = "slip";
  slip.where = {"deck.ups", 12, 3};
  try {
    Tube tube(whole_side({slip}));
    FAIL() << "slip was accepted";
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("deck.ups:12:3"), std::string::npos) << e.what();
    EXPECT_NE(std::string(e.what()).find("slip"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace sluice::ice::boundary_fill_test
