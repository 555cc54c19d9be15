// Smooth flows: order of convergence, symmetry of directions, Mach-independent dissipation.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "framework/base/exact_sum.hpp"
#include "verification/case_run.hpp"

namespace sluice::verification::smooth_flow_test {
namespace {

constexpr double lowest_order = 1.9;  // sound 2.15, simple 2.19, advection 2.31, vortex 2.48

double order(double coarse, double fine) {
  return std::log2(coarse / fine);
}

struct Wave {
  const char* deck;
  int coarse, fine;
};
class SmoothWave : public testing::TestWithParam<Wave> {};

TEST_P(SmoothWave, DensityErrorFallsWithTheSquareOfTheSpacing) {
  const Wave& wave = GetParam();
  const CaseRun coarse(wave.deck, {resolution(wave.coarse)});
  const CaseRun fine(wave.deck, {resolution(wave.fine)});
  const double observed = order(coarse.error("rho_CC").l1, fine.error("rho_CC").l1);
  record("order", observed);
  EXPECT_GE(observed, lowest_order);
  EXPECT_EQ(coarse.events() + fine.events(), 0);
}

INSTANTIATE_TEST_SUITE_P(One, SmoothWave,
                         testing::Values(Wave{"sound_wave", 64, 128}, Wave{"simple_wave", 64, 128},
                                         Wave{"advection_smooth", 64, 128}),
                         [](const auto& test) { return std::string(test.param.deck); });

TEST(SmoothFlow, LeftAndRightGoingSoundHaveTheSameErrorToTheBit) {
  // Means over cells are sums of rounded values at places that mirror images do not share.
  const std::string centre = "CFD/ICE/customInitialization/formula/@over=centre";
  const CaseRun right("sound_wave", {centre});
  const CaseRun left(
      "sound_wave",
      {centre,
       "CFD/ICE/customInitialization/formula/velocity_x=-5*((1 + 1e-6*cos(2*pi*x))^0.2 - 1)",
       "Meta/exact_solution/sense=-1"});
  const CellValues a = right.field("rho_CC"), b = left.field("rho_CC");
  const CellValues ua = right.field("vel_CC"), ub = left.field("vel_CC");
  const int n = a.size.x;
  for (int i = 0; i < n; ++i) {
    ASSERT_EQ(a.at(i), b.at(n - 1 - i)) << i;
    ASSERT_EQ(ua.at(i), -ub.at(n - 1 - i)) << i;
  }
  EXPECT_GT(highest(a) - lowest(a), 1.5e-6);  // the wave is still there
}

TEST(SmoothFlow, IsentropicVortexConvergesAtSecondOrder) {
  const CaseRun coarse("vortex", {resolution(64, 64)});
  const CaseRun fine("vortex", {resolution(128, 128)});
  const double observed = order(coarse.error("rho_CC").l1, fine.error("rho_CC").l1);
  record("order", observed);
  EXPECT_GE(observed, lowest_order);
  EXPECT_EQ(coarse.events() + fine.events(), 0);
}

// Share of the kinetic energy that a quarter turn leaves, 32 x 32 cells. Measured at Mach 0.1, 0.01
// and 0.001: 0.980, 0.977, 0.955.
struct Turn {
  double mach, min_share;
};
class Gresho : public testing::TestWithParam<Turn> {
 protected:
  static double kinetic_energy(const CaseRun& run, const std::string& which) {
    const CellValues rho = run.field("rho_CC", 0, which);
    const CellValues u = run.field("vel_CC", 0, which), v = run.field("vel_CC", 1, which);
    ExactSum sum;
    for (std::size_t i = 0; i < rho.values.size(); ++i) {
      sum.add(0.5 * rho.values[i] * (u.values[i] * u.values[i] + v.values[i] * v.values[i]));
    }
    return sum.value();
  }
};

TEST_P(Gresho, VortexKeepsItsKineticEnergyAtAnyMachNumber) {
  const Turn& turn = GetParam();
  const double mean = 1 / (1.4 * turn.mach * turn.mach);
  const std::string r = "sqrt(x^2 + y^2)";
  const std::string pressure = fmt::format(
      "{0:.17g} + ({1} < 0.2 ? 12.5*(x^2 + y^2) : {1} < 0.4 ? 12.5*(x^2 + y^2) + 4*(1 - 5*{1} + "
      "log(5*{1})) : 4*log(2) - 2)",
      mean, r);
  const CaseRun run("gresho", {"CFD/ICE/customInitialization/formula/pressure=" + pressure,
                               fmt::format("Meta/exact_solution/mach={}", turn.mach)});
  const double share = kinetic_energy(run, "last") / kinetic_energy(run, "first");
  record("share", share);
  EXPECT_GE(share, turn.min_share);
  EXPECT_LE(share, 1);
}

const auto name_of_turn = [](const auto& test) {
  return fmt::format("Mach1e{}", std::lround(std::log10(test.param.mach)) * -1);
};
INSTANTIATE_TEST_SUITE_P(AllSpeeds, Gresho, testing::Values(Turn{.1, .97}, Turn{.01, .96}),
                         name_of_turn);
INSTANTIATE_TEST_SUITE_P(Full, Gresho, testing::Values(Turn{.001, .94}), name_of_turn);

TEST(SmoothFlow, UniformFlowStaysUniform) {
  constexpr double limit = 1e-12;  // 0
  const CaseRun run("uniform_flow");
  double worst =
      std::max(farthest_from(run.field("rho_CC"), 1.3), farthest_from(run.field("press_CC"), .9));
  const double velocity[] = {.7, -.4, .2};
  for (const int d : {0, 1, 2}) {
    worst = std::max(worst, farthest_from(run.field("vel_CC", d), velocity[d]));
  }
  record("worst", worst);
  EXPECT_LE(worst, limit);
}

TEST(SmoothFlow, ContactKeepsPressureAndVelocityUniform) {
  constexpr double limit = 1e-10;  // pressure 1.1e-15, velocity 2.8e-14
  for (const std::string velocity : {"1", "-0.3", "0"}) {
    const std::string setting = "/velocity=[" + velocity + ",0,0]";
    const std::string object = "MaterialProperties/ICE/material/geom_object";
    const CaseRun run("contact", {object + "[1]" + setting, object + "[2]" + setting});
    const double p = farthest_from(run.field("press_CC"), 1);
    const double u = farthest_from(run.field("vel_CC"), std::stod(velocity));
    record("pressure", p);
    record("velocity", u);
    EXPECT_LE(p, limit) << velocity;
    EXPECT_LE(u, limit) << velocity;
    EXPECT_GT(highest(run.field("rho_CC")) / lowest(run.field("rho_CC")), 9e4);
  }
}

TEST(SmoothFlow, ColumnStaysAtRestInGravity) {
  constexpr double limit = 1e-10;  // of the sound speed; 3.9e-16
  const double sound_speed = std::sqrt(1.4 * 101325 / 1.2);
  const CaseRun run("hydrostatic_column", {"Time/maxTime=1000", "DataArchiver/outputInterval=1000"},
                    {"--max-steps", "100000"});
  EXPECT_EQ(run.steps(), 100000);
  const double share = farthest_from(run.field("vel_CC", 1), 0) / sound_speed;
  record("share", share);
  EXPECT_LE(share, limit);
  const CellValues p = run.field("press_CC");
  EXPECT_NEAR(p.at(0, 0) - p.at(0, p.size.y - 1), 1.2 * 9.81 * 63. / 64, 1e-6);
}

}  // namespace
}  // namespace sluice::verification::smooth_flow_test
