// Ghosts of open faces: waves that leave, swinging pressures, inlet profiles.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "framework/base/error.hpp"
#include "ice/boundary/boundary_fill.hpp"
#include "ice/boundary/waves.hpp"
#include "ice/conditions/inlet_profile.hpp"
#include "ice/conditions/sine.hpp"
#include "ice/fluid/labels.hpp"

namespace sluice::ice::wave_ghosts_test {
namespace {

constexpr double far_pressure = 10;

Condition condition(const char* variable, const char* kind, Vec3 value = {}) {
  Condition c;
  c.variable = variable;
  c.kind_name = kind;
  c.kind = c.kind_name == "Dirichlet" ? ConditionKind::dirichlet : ConditionKind::other;
  if (c.kind_name == "Neumann") c.kind = ConditionKind::neumann;
  c.has_value = true;
  c.is_vector = c.variable == "Velocity";
  c.vector = value;
  c.value = value.x;
  return c;
}

std::vector<Condition> open_face() {
  return {condition("Pressure", "LODI"), condition("Velocity", "LODI"),
          condition("Temperature", "LODI"), condition("Density", "LODI")};
}

// A plane of cells with a state of its own in each; the same region on all sides.
class Plane {
 public:
  Plane(std::vector<Condition> conditions, FlowConditions blocks, double gravity = 0)
      : blocks_(std::move(blocks)) {
    Level level;
    level.domain = {{0, 0, 0}, {12, 10, 1}};
    level.active = {true, true, false};
    level.boxes = {{level.domain, 0, 0}};
    level.spacing = {0.1, 0.2, 1};
    scene_.grid.levels = {level};
    scene_.constants.gravity = {gravity, 0, 0};
    BoundaryRegion region;
    region.conditions = std::move(conditions);
    for (Side side : all_sides) scene_.boundary.sides[index_of(side)].regions = {region};
    const Labels& l = labels();
    state_ = std::make_unique<Warehouse>(scene_.grid.levels.front(), 0);
    state_->add({l.mass, 0, 1, 3});
    state_->add({l.momentum, 0, 2, 3});
    state_->add({l.energy, 0, 1, 3});
  }
  // f(x, y) -> (rho, u, v, p) at cell centres; then ghosts at a time.
  template <class F>
  void fill(F&& f, double time = 0) {
    for_each_cell(scene_.grid.levels.front().domain, [&](IntVec3 c) {
      const std::array<double, 4> s = f(0.1 * (c.x + 0.5), 0.2 * (c.y + 0.5));
      state_->view(0, 0, 0)(c) = s[0];
      state_->view(1, 0, 0)(c) = s[0] * s[1];
      state_->view(1, 1, 0)(c) = s[0] * s[2];
      state_->view(2, 0, 0)(c) = s[3] / 0.4;
    });
    const Labels& l = labels();
    const BoundaryFill boundary(scene_, material_, {l.mass, l.momentum, l.energy, 0, {0, 1}}, 0,
                                blocks_);
    std::vector<ExactSum> exact(boundary.sum_count());
    boundary.add_sums(*state_, exact);
    std::vector<double> sums;
    for (const ExactSum& sum : exact) sums.push_back(sum.value());
    boundary.fill(*state_, ThreadTeam(), time, sums);
  }
  int sum_count() const {
    const Labels& l = labels();
    return BoundaryFill(scene_, material_, {l.mass, l.momentum, l.energy, 0, {0, 1}}, 0, blocks_)
        .sum_count();
  }
  double rho(int i, int j) const { return state_->view(0, 0, 0)(i, j, 0); }
  double u(int i, int j, int c = 0) const { return state_->view(1, c, 0)(i, j, 0) / rho(i, j); }
  double p(int i, int j) const { return 0.4 * state_->view(2, 0, 0)(i, j, 0); }

 private:
  Scene scene_;
  IceMaterial material_;
  FlowConditions blocks_;
  std::unique_ptr<Warehouse> state_;
};

FlowConditions lodi(double sigma = 0) {
  FlowConditions c;
  c.lodi = LodiSettings{};
  c.lodi->press_infinity = far_pressure;
  c.lodi->sigma = sigma;
  return c;
}

const double sound = std::sqrt(1.4 * far_pressure);

TEST(WaveGhosts, ContinueWhatLeavesAndLetNothingIn) {
  // Small sound waves along +x on a mean flow: nothing comes in at x+, all is lost at x-.
  constexpr double height = 1e-6, slope = 3;
  Plane plane(open_face(), lodi());
  plane.fill([&](double x, double) {
    const double wave = height * std::sin(slope * x);
    return std::array{1 + wave / (sound * sound), 0.5 + wave / sound, 0.0, far_pressure + wave};
  });
  for (int layer = 0; layer < 3; ++layer) {
    const double last = plane.p(11, 4), step = (1 + layer) * (last - plane.p(10, 4));
    EXPECT_NEAR(plane.p(12 + layer, 4), last + step, 1e-3 * std::fabs(step));
    EXPECT_NEAR(plane.u(12 + layer, 4) - plane.u(11, 4), step / sound,
                1e-3 * std::fabs(step) / sound);
    EXPECT_NEAR(plane.p(-1 - layer, 4), plane.p(0, 4), 1e-3 * height);
  }
}

TEST(WaveGhosts, UniformFlowIsContinuedToTheBit) {
  for (const double speed : {0.7, -0.7, 9.0, -9.0}) {
    Plane plane(open_face(), lodi(0.27));
    plane.fill([&](double, double) { return std::array{1.5, speed, 0.25, far_pressure}; });
    for (const auto& [i, j] : {std::pair{-3, 2}, {12, 9}, {4, -2}, {7, 11}, {-1, -2}, {13, 12}}) {
      EXPECT_EQ(plane.rho(i, j), 1.5);
      EXPECT_DOUBLE_EQ(plane.u(i, j), speed);
      EXPECT_DOUBLE_EQ(plane.p(i, j), far_pressure);
    }
  }
}

// A sheared stream and what it makes of sound. The mean across x+ is 1; across y- it is -1, across
// y+ it is 3: together 1.
std::array<double, 4> stream(double x, double y) {
  const double U = 0.5 + 0.5 * (x - 0.05) / 1.1 + 0.4 * (y - 1), V = 2 * (y - 1) / 0.9 + 1;
  return {1 + 0.1 * x, U, V, far_pressure + std::sin(3 * y)};
}

TEST(WaveGhosts, TheMeanOverAnOpenFaceTakesThePlaceOfAFlowFarAway) {
  FlowConditions given = lodi();
  given.lodi->velocity_infinity = Vec3{1, 1, 0};
  given.lodi->rho_infinity = 1;
  Plane mean(open_face(), lodi()), far(open_face(), given);
  for (Plane* plane : {&mean, &far}) plane->fill(stream);
  for (int j = 0; j < 10; ++j) {
    EXPECT_NEAR(mean.p(12, j), far.p(12, j), 1e-13 * far_pressure) << j;
    EXPECT_NEAR(mean.u(12, j), far.u(12, j), 1e-13) << j;
  }
}

// A slow stream beside a fast jet: c - (U - U0) would be a third of c in the jet.
TEST(WaveGhosts, AMeanFarFromTheFlowMakesTheWaveTwiceAsStrongAtMost) {
  WaveCell cell;
  cell.here = {1, 1, {0.7, 0, 0}};
  cell.along[0].u[1] = 0.25;
  const double local = transverse_part(cell);
  EXPECT_EQ(local, 0.125);
  cell.carrier_known = true;
  EXPECT_EQ(transverse_part(cell), 2 * local);
  cell.carrier.u[0] = 0.45;
  EXPECT_DOUBLE_EQ(transverse_part(cell), local / 0.75);
}

// Nor does a flow far away that is given: behind a strong shock U comes near c, or passes U0 + c.
TEST(WaveGhosts, AFlowFarAwayFarFromThatInsideMakesTheWaveTwiceAsStrongAtMost) {
  const auto fast = [](double x, double y) {
    return std::array{1.0, 0.9 * sound + 0.01 * x, std::sin(2 * y), far_pressure + std::sin(3 * y)};
  };
  const auto pressure = [&](double U0) {
    FlowConditions given = lodi();
    given.lodi->velocity_infinity = Vec3{U0 * sound, 0, 0};
    given.lodi->rho_infinity = 1;
    Plane plane(open_face(), given);
    plane.fill(fast);
    std::vector<double> p;
    for (int j = 0; j < 10; ++j) p.push_back(plane.p(12, j));
    return p;
  };
  const std::vector<double> bounded = pressure(0);
  EXPECT_EQ(pressure(-0.2), bounded);
  EXPECT_EQ(pressure(0.3), bounded);
  EXPECT_NE(pressure(0.6), bounded);
}

TEST(WaveGhosts, OnlyFacesWithoutAFlowFarAwayAskForSums) {
  const auto sums = [](std::vector<Condition> conditions, const FlowConditions& blocks) {
    return Plane(std::move(conditions), blocks).sum_count();
  };
  FlowConditions given = lodi();
  given.lodi->velocity_infinity = Vec3{4, 1, 0};
  given.lodi->rho_infinity = 1;
  EXPECT_EQ(sums(open_face(), lodi()), 14);  // three directions, four faces
  EXPECT_EQ(sums(open_face(), given), 0);
  EXPECT_EQ(sums({condition("Pressure", "Neumann")}, lodi()), 0);
}

TEST(WaveGhosts, PressureIsDrawnToThatFarAway) {
  Plane plane(open_face(), lodi(0.27));
  plane.fill([](double, double) { return std::array{1.0, 0.0, 0.0, 1.1 * far_pressure}; });
  // sigma dx (p - p_inf)/(2 L), L = 12 dx; velocity outward with it.
  const double fall = 0.27 * 0.1 * far_pressure / 24, c = std::sqrt(1.4 * 1.1 * far_pressure);
  EXPECT_NEAR(1.1 * far_pressure - plane.p(12, 4), fall, 1e-12);
  EXPECT_NEAR(plane.u(12, 4), fall / c, 1e-12);
  EXPECT_NEAR(plane.u(-1, 4), -fall / c, 1e-12);
}

TEST(WaveGhosts, GasAtRestUnderGravityStaysInBalance) {
  FlowConditions blocks = lodi(0);
  Plane plane(open_face(), blocks, -2);
  double pressure[12];
  for (int i = 0; i < 12; ++i) pressure[i] = far_pressure - 2 * 0.1 * 1.5 * i;
  plane.fill([&](double x, double) {
    return std::array{1.5, 0.0, 0.0, pressure[static_cast<int>(x / 0.1)]};
  });
  EXPECT_NEAR(plane.p(12, 3) - plane.p(11, 3), -0.3, 1e-13);
  EXPECT_NEAR(plane.p(-1, 3) - plane.p(0, 3), 0.3, 1e-13);
  EXPECT_NEAR(plane.u(12, 3), 0, 1e-14);
}

TEST(WaveGhosts, MirroredFacesGiveMirroredBits) {
  const auto state = [](double x, double y) {
    return std::array{1 + 0.2 * std::sin(5 * x + y), std::cos(3 * x * y), std::sin(7 * y - x),
                      far_pressure + std::sin(4 * x - 3 * y)};
  };
  Plane plane(open_face(), lodi(0.27)), image(open_face(), lodi(0.27));
  plane.fill(state);
  image.fill([&](double x, double y) {
    // The centre of the mirrored cell, with the bits of the other plane.
    const int i = 11 - static_cast<int>(x / 0.1);
    std::array<double, 4> s = state(0.1 * (i + 0.5), y);
    s[1] = -s[1];
    return s;
  });
  for (int j = -3; j < 13; ++j)
    for (int layer = 0; layer < 3; ++layer) {
      EXPECT_EQ(plane.rho(12 + layer, j), image.rho(-1 - layer, j)) << j;
      EXPECT_EQ(plane.u(12 + layer, j), -image.u(-1 - layer, j)) << j;
      EXPECT_EQ(plane.u(12 + layer, j, 1), image.u(-1 - layer, j, 1)) << j;
      EXPECT_EQ(plane.p(12 + layer, j), image.p(-1 - layer, j)) << j;
    }
}

TEST(WaveGhosts, KeepDensityAndPressurePositiveBehindSteepSlopes) {
  Plane plane(open_face(), lodi(0.27));
  plane.fill([](double x, double) {
    return std::array{x > 1.1 ? 0.01 : 1.0, 1.0, 0.0, x > 1.1 ? 0.02 : 10.0};
  });
  for (int layer = 0; layer < 3; ++layer) {
    EXPECT_GT(plane.rho(12 + layer, 3), 0.0);
    EXPECT_GT(plane.p(12 + layer, 3), 0.0);
  }
}

// What will have come to the face from one and a half cells outside with gas and sound.
TEST(SwingingGhosts, FollowTheTime) {
  FlowConditions blocks;
  blocks.flows = {{"Sine", std::make_shared<SineFlow>(SineSettings{2.0, 3.0, 10.0, {5, 0, 0}})}};
  Plane plane({condition("Pressure", "Sine"), condition("Velocity", "Sine"),
               condition("Temperature", "Sine"), condition("Density", "Neumann")},
              blocks);
  plane.fill([](double, double) { return std::array{1.5, 1.0, 1.0, 10.0}; }, 0.3);
  const double inward = 1.0 + std::sqrt(1.4 * 10.0 / 1.5), off = 1.5 * 0.1;
  const double swing = 3 * std::sin(2 * (0.3 + off / inward));
  EXPECT_DOUBLE_EQ(plane.p(-2, 4), 10 + swing);
  EXPECT_DOUBLE_EQ(plane.rho(-2, 4), 1.5);
  EXPECT_DOUBLE_EQ(plane.u(-2, 4), 5 + swing);
  EXPECT_EQ(plane.u(-2, 4, 1), 0.0);
}

TEST(InletProfiles, FollowTheHeight) {
  FlowConditions blocks;
  InletProfile profile;
  profile.exponent = 0.5;
  profile.height = 1.0;
  profile.roughness = 0.2;
  blocks.flows = {{"powerLawProfile", std::make_shared<PowerLawFlow>(profile)},
                  {"logLawProfile", std::make_shared<LogLawFlow>(profile)}};
  const std::vector<Condition> power = {condition("Velocity", "powerLawProfile", {4, 0, 0})};
  Plane plane(power, blocks);
  const auto still = [](double, double) { return std::array{1.0, 0.0, 0.0, 10.0}; };
  plane.fill(still);
  EXPECT_DOUBLE_EQ(plane.u(-1, 2), 4 * std::sqrt(0.5));
  EXPECT_DOUBLE_EQ(plane.u(-1, 8), 4.0);
  Plane log_law({condition("Velocity", "logLawProfile", {4, 0, 0})}, blocks);
  log_law.fill(still);
  EXPECT_DOUBLE_EQ(log_law.u(-1, 2), 4 * std::log(0.5 / 0.2) / 0.4);
  EXPECT_EQ(log_law.u(-1, 0), 0.0);  // below the roughness
}

TEST(WaveGhosts, NeedTheirBlock) {
  try {
    Plane plane(open_face(), {});
    plane.fill([](double, double) { return std::array{1.0, 0.0, 0.0, 10.0}; });
    FAIL() << "LODI without its block was accepted";
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("<LODI>"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace sluice::ice::wave_ghosts_test
