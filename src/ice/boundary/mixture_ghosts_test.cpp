// Ghost states of two materials: copies, walls, outlets, inflow of a mixture, what is refused.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "framework/base/error.hpp"
#include "ice/boundary/boundary_fill.hpp"
#include "ice/conditions/inlet_profile.hpp"
#include "ice/conditions/sine.hpp"
#include "ice/fluid/labels.hpp"
#include "ice/test_support/conditions.hpp"
#include "ice/test_support/fluid.hpp"

namespace sluice::ice::mixture_ghosts_test {
namespace {

Condition given(const char* variable, double value, int material = -1) {
  return condition(variable, ConditionKind::dirichlet, value, material);
}
const Fluid water = stiffened_gas(4.4, 6e8, 4180);

// Eight cells along x, air to the left, water to the right, three cells of both between them; at
// 2 m/s and 1e5 Pa. The same region on both ends.
class TwoMaterials {
 public:
  explicit TwoMaterials(std::vector<Condition> conditions, double gravity = 0,
                        const FlowConditions& blocks = {}, double time = 0) {
    Level level;
    level.domain = {{0, 0, 0}, {8, 1, 1}};
    level.active = {true, false, false};
    level.boxes = {{level.domain, 0, 0}};
    scene_.grid.levels = {level};
    scene_.constants.gravity = {gravity, 0, 0};
    BoundaryRegion region;
    region.conditions = std::move(conditions);
    region.name = "side x-";
    for (Side side : {Side::x_minus, Side::x_plus})
      scene_.boundary.sides[index_of(side)].regions = {region};
    materials_.resize(2);
    materials_[0].fluid = ideal_gas(1.4, 717.5);
    materials_[1].fluid = water;
    materials_[1].index = 1;
    const Labels& l = labels();
    state_ = std::make_unique<Warehouse>(scene_.grid.levels.front(), 0);
    for (int m = 0; m < 2; ++m) state_->add({l.mass, m, 1, 3});
    state_->add({l.momentum, 0, 2, 3});
    for (int m = 0; m < 2; ++m) state_->add({l.energy, m, 1, 3});
    for (int m = 0; m < 2; ++m) state_->add({l.volume, m, 1, 3});
    const double share[] = {1, 0.75, 1, 1, 0.5, 0, 0.125, 0};
    for (int i = 0; i < 8; ++i) {
      const double V[] = {share[i], 1 - share[i]}, rho[] = {1.2 + 0.1 * i, 1000.0 + i};
      for (int m = 0; m < 2; ++m) {
        at(l.mass, m, i) = V[m] * rho[m];
        at(l.volume, m, i) = V[m];
        at(l.energy, m, i) = V[m] > 0 ? V[m] * fluid(m).energy_from_pressure(rho[m], 1e5, 0) : 0;
      }
      at(l.momentum, 0, i) = 2 * density(i);
      at(l.momentum, 0, i, 1) = 0.5 * density(i);
    }
    BoundaryFill(scene_, materials_, {l.mass, l.momentum, l.energy, 0, {0, 1}, l.volume}, 0, blocks)
        .fill(*state_, ThreadTeam(), time);
  }

  double& at(Label label, int m, int i, int c = 0) const {
    return state_->view(state_->find(label, m), c, 0)(i, 0, 0);
  }
  double mass(int m, int i) const { return at(labels().mass, m, i); }
  double volume(int m, int i) const { return at(labels().volume, m, i); }
  double energy(int m, int i) const { return at(labels().energy, m, i); }
  double density(int i) const { return mass(0, i) + mass(1, i); }
  double u(int i, int c = 0) const { return at(labels().momentum, 0, i, c) / density(i); }
  double p(int m, int i) const {
    return fluid(m).pressure(mass(m, i) / volume(m, i), energy(m, i) / volume(m, i));
  }
  const Fluid& fluid(int m) const { return materials_[m].fluid; }

 private:
  Scene scene_;
  std::vector<IceMaterial> materials_;
  std::unique_ptr<Warehouse> state_;
};

// Does a ghost hold what a cell holds, to the bit.
bool same_materials(const TwoMaterials& tube, int ghost, int cell) {
  bool same = true;
  for (int m = 0; m < 2; ++m)
    same = same && tube.mass(m, ghost) == tube.mass(m, cell) &&
           tube.volume(m, ghost) == tube.volume(m, cell) &&
           tube.energy(m, ghost) == tube.energy(m, cell);
  return same;
}

const Condition outflow = velocity(ConditionKind::neumann, {});

TEST(MixtureGhosts, SymmetryMirrorsAllMaterials) {
  const TwoMaterials tube({condition("Symmetric", ConditionKind::symmetry, 0)});
  for (int layer = 0; layer < 3; ++layer) {
    EXPECT_TRUE(same_materials(tube, -1 - layer, layer));
    EXPECT_TRUE(same_materials(tube, 8 + layer, 7 - layer));
    EXPECT_EQ(tube.u(-1 - layer), -2.0);
    EXPECT_EQ(tube.u(8 + layer, 1), 0.5);
  }
}

TEST(MixtureGhosts, ZeroGradientsCopyAllMaterials) {
  const TwoMaterials tube({condition("Pressure", ConditionKind::neumann, 0, 0),
                           condition("Density", ConditionKind::neumann, 0),
                           condition("Temperature", ConditionKind::neumann, 0), outflow});
  for (int layer = 0; layer < 3; ++layer) {
    EXPECT_TRUE(same_materials(tube, -1 - layer, 0));
    EXPECT_TRUE(same_materials(tube, 8 + layer, 7));
  }
  EXPECT_EQ(tube.volume(0, -2), 1.0);
  EXPECT_EQ(tube.mass(1, -2), 0.0);
}

TEST(MixtureGhosts, AnOutletPressureIsThatOfAllMaterials) {
  const TwoMaterials tube({given("Pressure", 2e5), outflow});
  EXPECT_DOUBLE_EQ(tube.p(0, -1), 2e5);
  EXPECT_EQ(tube.volume(0, -1), 1.0);
  EXPECT_EQ(tube.energy(1, -1), 0.0);
  EXPECT_DOUBLE_EQ(tube.mass(0, -1), tube.mass(0, 0));
  EXPECT_NEAR(tube.p(1, 9), 2e5, 1e-5);  // beside 6e8
  EXPECT_EQ(tube.mass(0, 9), 0.0);
}

TEST(MixtureGhosts, AWallOfGivenTemperatureKeepsWhatTheMaterialsFill) {
  const TwoMaterials tube({given("Temperature", 300), velocity(ConditionKind::dirichlet, {})});
  for (const int ghost : {-2, 9}) {
    const int cell = ghost < 0 ? 1 : 6;
    for (int m = 0; m < 2; ++m) {
      EXPECT_DOUBLE_EQ(tube.volume(m, ghost), tube.volume(m, cell));
      if (tube.volume(m, ghost) == 0) continue;
      EXPECT_NEAR(tube.p(m, ghost), 1e5, 1e-5);
      const double rho = tube.mass(m, ghost) / tube.volume(m, ghost);
      EXPECT_NEAR(rho / tube.fluid(m).density(1e5, 300), 1.0, 1e-12);
    }
    EXPECT_DOUBLE_EQ(tube.u(ghost), -2.0);
  }
}

std::vector<Condition> inflow(double share, bool with_pressure) {
  const double air = ideal_gas(1.4, 717.5).density(3e5, 280), liquid = water.density(3e5, 310);
  std::vector<Condition> conditions = {given("Density", share * air, 0),
                                       given("Density", (1 - share) * liquid, 1),
                                       given("Temperature", 280, 0), given("Temperature", 310, 1),
                                       velocity(ConditionKind::dirichlet, {3, 1, 0})};
  if (with_pressure) conditions.push_back(given("Pressure", 3e5, 0));
  return conditions;
}

TEST(MixtureGhosts, DensitiesAndTemperaturesTellWhatAnInflowFills) {
  for (const bool with_pressure : {true, false}) {
    const TwoMaterials tube(inflow(0.3, with_pressure));
    for (const int ghost : {-3, -1, 8}) {
      EXPECT_NEAR(tube.volume(0, ghost), 0.3, 1e-9) << with_pressure;
      EXPECT_DOUBLE_EQ(tube.volume(0, ghost) + tube.volume(1, ghost), 1.0);
      EXPECT_NEAR(tube.p(0, ghost), 3e5, 1e-3);
      EXPECT_NEAR(tube.p(1, ghost), 3e5, 1e-3);
      EXPECT_DOUBLE_EQ(tube.u(ghost), 3);
      EXPECT_DOUBLE_EQ(tube.u(ghost, 1), 1);
    }
  }
}

TEST(MixtureGhosts, ATraceOfDensityIsNone) {
  const TwoMaterials tube({given("Density", 1.3, 0), given("Density", 1e-12, 1),
                           given("Temperature", 290),
                           velocity(ConditionKind::dirichlet, {4, 0, 0}, 0),
                           velocity(ConditionKind::dirichlet, {}, 1)});
  for (const int ghost : {-1, 10}) {
    EXPECT_EQ(tube.volume(0, ghost), 1.0);
    EXPECT_EQ(tube.mass(0, ghost), 1.3);
    EXPECT_EQ(tube.mass(1, ghost), 0.0);
    EXPECT_EQ(tube.energy(1, ghost), 0.0);
    EXPECT_DOUBLE_EQ(tube.u(ghost), 4);
  }
}

// One material is given, the other takes the room that is left.
TEST(MixtureGhosts, MaterialsThatAreNotGivenFillTheRest) {
  const double air = ideal_gas(1.4, 717.5).density(1e5, 300);
  const TwoMaterials tube({given("Density", 0.25 * air, 0), given("Temperature", 300, 0),
                           given("Pressure", 1e5, 0),
                           velocity(ConditionKind::dirichlet, {1, 0, 0})});
  EXPECT_NEAR(tube.volume(0, 8), 0.25, 1e-15);
  EXPECT_NEAR(tube.mass(1, 8), 0.75 * tube.mass(1, 7), 1e-9);
  EXPECT_EQ(tube.volume(0, -1), 1.0);  // there is no water that could
}

TEST(MixtureGhosts, UnderGravityTheMixtureWeighs) {
  const double g = -3;
  const TwoMaterials tube({condition("Symmetric", ConditionKind::symmetry, 0)}, g);
  // Through the mirrored cells out to the second ghost.
  for (int m = 0; m < 2; ++m)
    EXPECT_NEAR(tube.p(m, -2) - 1e5, -g * (tube.density(1) + 2 * tube.density(0)), 1e-5);
}

TEST(MixtureGhosts, AMixtureHeavierThanItsPressureLeavesATenthOfIt) {
  // Above the lowest pressure of what is there: that of the gas, 0.
  for (const double g : {-3e5, 3e5}) {
    const TwoMaterials tube({condition("Symmetric", ConditionKind::symmetry, 0)}, g);
    for (int m = 0; m < 2; ++m) EXPECT_NEAR(tube.p(m, g > 0 ? -2 : 9), 1e4, 1e-5);
  }
}

TEST(MixtureGhosts, GivenSpecificVolumesTellWhatAnInflowFills) {
  // Mass per volume of the cell times volume per mass is the share of the cell.
  const TwoMaterials tube({given("Density", 0.5, 0), given("Density", 600, 1),
                           given("SpecificVol", 0.8, 0), given("SpecificVol", 1e-3, 1),
                           given("Pressure", 3e5, 0),
                           velocity(ConditionKind::dirichlet, {3, 0, 0})});
  for (const int ghost : {-3, 8}) {
    EXPECT_DOUBLE_EQ(tube.volume(0, ghost), 0.4);
    EXPECT_DOUBLE_EQ(tube.volume(1, ghost), 0.6);
    EXPECT_DOUBLE_EQ(tube.mass(0, ghost), 0.5);
    EXPECT_DOUBLE_EQ(tube.mass(1, ghost), 600);
    EXPECT_NEAR(tube.p(0, ghost), 3e5, 1e-6);
    EXPECT_NEAR(tube.p(1, ghost), 3e5, 1e-3);  // beside 6e8
  }
}

TEST(MixtureGhosts, ASpecificVolumeFromTheDensityChangesNothing) {
  const TwoMaterials without(inflow(0.3, true));
  for (const ConditionKind kind : {ConditionKind::compute_from_density, ConditionKind::neumann}) {
    std::vector<Condition> conditions = inflow(0.3, true);
    conditions.push_back(condition("SpecificVol", kind, 0));
    const TwoMaterials with(std::move(conditions));
    for (const int ghost : {-1, 9})
      for (int m = 0; m < 2; ++m) {
        EXPECT_EQ(with.volume(m, ghost), without.volume(m, ghost));
        EXPECT_EQ(with.mass(m, ghost), without.mass(m, ghost));
        EXPECT_EQ(with.energy(m, ghost), without.energy(m, ghost));
      }
  }
}

Condition special(const char* variable, const char* kind, Vec3 value = {}) {
  Condition c = velocity(ConditionKind::other, value);
  c.variable = variable;
  c.kind_name = kind;
  return c;
}

TEST(MixtureGhosts, ASwingingPressureIsThatOfAllMaterials) {
  FlowConditions blocks;
  blocks.flows = {{"Sine", std::make_shared<SineFlow>(SineSettings{2.0, 3e4, 1e5, {0, 0, 0}})}};
  // What will have come to the face with the speed of sound, with and against the gas at 2 m/s.
  const auto p = [](double off, double inward) {
    return 1e5 + 3e4 * std::sin(2 * (0.3 + off / inward));
  };
  const double in_air = std::sqrt(1.4 * 1e5 / 1.2), in_water = std::sqrt(4.4 * 6.001e8 / 1007);
  const TwoMaterials tube({special("Pressure", "Sine"), outflow}, 0, blocks, 0.3);
  EXPECT_NEAR(tube.p(0, -2), p(1.5, in_air + 2), 1e-9);
  EXPECT_NEAR(tube.p(1, 8), p(0.5, in_water - 2), 1e-5);  // beside 6e8
  EXPECT_EQ(tube.volume(0, -2), 1.0);
  EXPECT_DOUBLE_EQ(tube.mass(1, 8), tube.mass(1, 7));
}

TEST(MixtureGhosts, AnInletProfileMovesAllMaterials) {
  FlowConditions blocks;
  InletProfile profile;
  profile.exponent = 0.5;
  profile.height = 4.0;  // the only row's centre lies at half a metre
  blocks.flows = {{"powerLawProfile", std::make_shared<PowerLawFlow>(profile)}};
  const TwoMaterials tube({special("Velocity", "powerLawProfile", {6, 0, 0})}, 0, blocks);
  for (const int ghost : {-1, 10}) EXPECT_DOUBLE_EQ(tube.u(ghost), 6 * std::sqrt(0.5 / 4.0));
  EXPECT_TRUE(same_materials(tube, 10, 7));
}

std::string refusal(std::vector<Condition> conditions) {
  try {
    const TwoMaterials tube(std::move(conditions));
  } catch (const InputError& e) {
    return e.what();
  }
  return {};
}

TEST(MixtureGhosts, VolumesThatDoNotFillACellAreRefused) {
  std::vector<Condition> conditions = inflow(0.3, true);
  conditions[0].value *= 1.5;
  EXPECT_NE(refusal(conditions).find("fill 1.15 of a cell"), std::string::npos)
      << refusal(conditions);
}

TEST(MixtureGhosts, DensitiesAloneDoNotSayWhatTheyFill) {
  const std::string text = refusal({given("Density", 0.5, 0), given("Density", 500, 1),
                                    velocity(ConditionKind::dirichlet, {1, 0, 0})});
  EXPECT_NE(text.find("SpecificVol"), std::string::npos) << text;
}

TEST(MixtureGhosts, ASpecificVolumeThatSaysNothingIsRefused) {
  EXPECT_NE(refusal({given("SpecificVol", 0.8, 0), outflow}).find("without the Density"),
            std::string::npos);
  EXPECT_NE(refusal({condition("SpecificVol", ConditionKind::neumann, 0.1, 0), outflow})
                .find("has the gradient 0.1"),
            std::string::npos);
}

TEST(MixtureGhosts, AWallForOneMaterialOnlyIsRefused) {
  const std::string text = refusal({velocity(ConditionKind::dirichlet, {1, 0, 0}, 0),
                                    velocity(ConditionKind::dirichlet, {}, 1)});
  EXPECT_NE(text.find("a wall for material 1"), std::string::npos) << text;
}

}  // namespace
}  // namespace sluice::ice::mixture_ghosts_test
