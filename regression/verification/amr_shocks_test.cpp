// Shocks on levels that follow them: as good as the uniform fine grid, and unseen by interfaces.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "verification/amr_case.hpp"

namespace sluice::verification::amr_shocks_test {
namespace {

// L1 error by that of the uniform fine grid. Measured, density, pressure and velocity: shock tube
// 0.998, 1.011, 1.025; explosion 0.981, 0.990, 1.000; square, without velocity, 1.001, 0.999.
constexpr double allowed_loss = 1.05;

double order(double coarse, double fine, double ratio) {
  return std::log(coarse / fine) / std::log(ratio);
}

void expect_as_good(const char* variable, double adaptive, double uniform) {
  record(fmt::format("{}_by_uniform", variable), adaptive / uniform);
  EXPECT_LE(adaptive, allowed_loss * uniform) << variable;
}

TEST(AmrShocks, ShockTubeIsAsGoodAsTheUniformFineGrid) {
  const CaseRun adaptive("amr_shock_tube");
  const CaseRun uniform("amr_shock_tube", {one_level(), resolution(800)});
  for (const char* variable : {"rho_CC", "press_CC", "vel_CC"})
    expect_as_good(variable, adaptive.error(variable).l1, uniform.error(variable).l1);
  EXPECT_LT(share_of_uniform(adaptive), .4);
  EXPECT_EQ(adaptive.events(), 0);
}

// The waves of the start are faster than the gas was: coarse steps that know nothing of them cost
// more than the levels do. From steps that grow slowly nothing is lost.
TEST(AmrShocks, ShockTubeLosesNothingByItsLevels) {
  constexpr double allowed = 1.;  // density 0.974, pressure 0.975, velocity 0.992
  const CaseRun adaptive("amr_shock_tube", {"Time/delt_init=0.0004", "Time/max_delt_increase=1.2"});
  const CaseRun uniform("amr_shock_tube", {one_level(), resolution(800)});
  for (const char* variable : {"rho_CC", "press_CC", "vel_CC"}) {
    const double loss = adaptive.error(variable).l1 / uniform.error(variable).l1;
    record(fmt::format("{}_by_uniform", variable), loss);
    EXPECT_LE(loss, allowed) << variable;
  }
}

// In a coarse step of 64 fine ones a wave crosses up to 0.4 x 16 cells of the level that flags the
// finest one: flags are widened by that many, whatever the deck says, and shocks stay on it.
TEST(AmrShocks, FlagsAreWidenedForSixtyFourSubsteps) {
  // Density 0.981, pressure 0.978, velocity 1.013; with dilation 1 1.70, 1.83, 2.16.
  const std::vector<std::string> start = {"Time/delt_init=0.00002", "Time/max_delt_increase=1.3"};
  std::vector<std::string> overrides = {resolution(16), "AMR/Regridder/max_levels=4", dilation(1)};
  overrides.insert(overrides.end(), start.begin(), start.end());
  const CaseRun adaptive("amr_shock_tube", overrides);
  const CaseRun uniform("amr_shock_tube", {one_level(), resolution(1024)});
  for (const char* variable : {"rho_CC", "press_CC", "vel_CC"})
    expect_as_good(variable, adaptive.error(variable).l1, uniform.error(variable).l1);
  EXPECT_LT(share_of_uniform(adaptive), .4);
}

TEST(FullAmrShocks, ExplosionIsAsGoodAsTheUniformFineGridAndConverges) {
  constexpr double min_order = .9;  // 0.951
  const CaseRun coarse("amr_explosion", {resolution(32, 32)}), fine("amr_explosion");
  const CaseRun uniform("amr_explosion", {one_level(), resolution(256, 256)}, {"--threads", "2"});
  for (const char* variable : {"rho_CC", "press_CC", "vel_CC"})
    expect_as_good(variable, fine.error(variable).l1, uniform.error(variable).l1);
  const double observed = order(coarse.error("rho_CC").l1, fine.error("rho_CC").l1, 2);
  record("order", observed);
  EXPECT_GE(observed, min_order);
  EXPECT_LT(share_of_uniform(fine), .5);
}

// No exact solution: both are measured against a grid four times as fine.
TEST(FullAmrShocks, RiemannSquareIsAsGoodAsTheUniformFineGrid) {
  const std::vector<std::string> both = {"Time/maxTime=0.2", "DataArchiver/outputInterval=0.2"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.end(), both.begin(), both.end());
    return more;
  };
  const CaseRun adaptive("amr_riemann_2d", with({resolution(32, 32)}));
  const CaseRun uniform("amr_riemann_2d", with({one_level(), resolution(128, 128)}));
  const CaseRun finer("amr_riemann_2d", with({one_level(), resolution(512, 512)}),
                      {"--threads", "2"});
  for (const char* variable : {"rho_CC", "press_CC", "vel_CC"}) {
    const CellValues reference = finer.field(variable);
    expect_as_good(variable, distance_from(adaptive, reference, variable),
                   distance_from(uniform, reference, variable));
  }
  EXPECT_LT(share_of_uniform(adaptive), .6);
}

}  // namespace
}  // namespace sluice::verification::amr_shocks_test
