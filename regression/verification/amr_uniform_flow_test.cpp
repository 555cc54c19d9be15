// Uniform flow through fixed and moving refined regions: levels leave no trace in it.
#include <gtest/gtest.h>

#include <algorithm>

#include "verification/amr_case.hpp"

namespace sluice::verification::amr_uniform_flow_test {
namespace {

// Measured: 0 in fixed regions, 8.9e-16 around the ball, 1.0e-13 with the ripple of that height.
constexpr double allowed = 1e-12;

// Worst of pressure and velocity on any level.
double unevenness(const CaseRun& run, Vec3 velocity) {
  double worst = farthest_on_levels(run, "press_CC", 0, .9);
  for (const int d : {0, 1, 2})
    worst = std::max(worst, farthest_on_levels(run, "vel_CC", d, velocity[d]));
  return worst;
}

TEST(AmrUniformFlow, StaysUniformThroughFixedRegions) {
  const CaseRun run("amr_uniform_flow", {}, {"--max-steps", "20"});
  const double worst =
      std::max(unevenness(run, {.7, -.4, .2}), farthest_on_levels(run, "rho_CC", 0, 1.3));
  record("worst", worst);
  EXPECT_LE(worst, allowed);
  EXPECT_EQ(max_cells(run).size(), 3u);
  EXPECT_EQ(run.events(), 0);
}

// A ripple of 1e-13 in the density, far above its round-off and far below what is allowed, draws
// the levels after it.
struct Follower {
  const char* name;
  std::vector<std::string> overrides;
  std::vector<std::string> options;
  Vec3 velocity;
  double least_regrids;  // a coarse step
};

class AmrRipple : public testing::TestWithParam<Follower> {};

TEST_P(AmrRipple, LevelsThatMoveLeaveTheFlowUniform) {
  const Follower& f = GetParam();
  std::vector<std::string> overrides = f.overrides;
  overrides.emplace_back(
      "CFD/ICE/customInitialization/formula/density=1.3 + 1e-13*exp(-100*((x - 0.3)^2 + (y - "
      "0.6)^2))");
  overrides.push_back("AMR/ICE/Refinement_Criteria_Thresholds/Variable/@value=4e-13");
  const CaseRun run("amr_carried_ball", overrides, f.options);
  const double worst =
      std::max(unevenness(run, f.velocity), farthest_on_levels(run, "rho_CC", 0, 1.3));
  record("worst", worst);
  record("regrids_a_step", static_cast<double>(regrids(run)) / run.steps());
  EXPECT_LE(worst, allowed);
  // The first step is as short as one of the finest level: nothing has moved after it.
  EXPECT_GE(regrids(run), f.least_regrids * (run.steps() - 1));
  const std::vector<long> cells = max_cells(run);
  ASSERT_EQ(cells.size(), 3u);
  EXPECT_GT(cells[2], 0);
  EXPECT_LT(share_of_uniform(run), .7);  // not everything is refined
  EXPECT_EQ(run.events(), 0);
}

const std::string flat = resolution(16, 16);

const auto name_of_follower = [](const auto& test) { return std::string(test.param.name); };
INSTANTIATE_TEST_SUITE_P(Full, AmrRipple,
                         testing::Values(Follower{
                             "Cube", {}, {"--max-steps", "8"}, {.7, -.4, .2}, .5}),
                         name_of_follower);
INSTANTIATE_TEST_SUITE_P(
    Of, AmrRipple,
    testing::Values(
        Follower{"CubeBegun", {}, {"--max-steps", "3"}, {.7, -.4, .2}, .5},
        Follower{"Ratios2And4", {flat}, {}, {.7, -.4, .2}, .5},
        Follower{"Ratios2And2",
                 {flat, "AMR/Regridder/cell_refinement_ratio=[[2,2,1]]",
                  "AMR/Regridder/min_patch_size=[[4,4,1]]"},
                 {},
                 {.7, -.4, .2},
                 .5},
        Follower{"Ratios4And4",
                 {flat, "AMR/Regridder/cell_refinement_ratio=[[4,4,1]]",
                  "AMR/Regridder/min_patch_size=[[8,8,1]]"},
                 {},
                 {.7, -.4, .2},
                 1},
        Follower{"Lockstep", {flat, "AMR/useLockStep=true"}, {}, {.7, -.4, .2}, .1},
        Follower{"Supersonic",
                 {flat, "MaterialProperties/ICE/material/geom_object/velocity=[7,-4,2]"},
                 {"--max-steps", "100"},
                 {7, -4, 2},
                 .88},
        Follower{"SecondOrderProlongation",
                 {flat, "AMR/ICE/orderOfInterpolation=2"},
                 {},
                 {.7, -.4, .2},
                 .5},
        Follower{"CopiedCells", {flat, "AMR/ICE/orderOfInterpolation=0"}, {}, {.7, -.4, .2}, .5}),
    name_of_follower);

TEST(AmrUniformFlow, CarriedBallKeepsPressureAndVelocityUniform) {
  const CaseRun run("amr_carried_ball",
                    {flat,
                     "CFD/ICE/customInitialization/formula/density=1.3 + 0.5*exp(-100*((x - "
                     "0.3)^2 + (y - 0.6)^2))"});
  const double worst = unevenness(run, {.7, -.4, .2});
  record("worst", worst);
  EXPECT_LE(worst, allowed);
  EXPECT_GE(regrids(run), .5 * run.steps());
  const std::vector<LevelCell> rho = level_cells(run, "rho_CC");
  const auto densest = std::max_element(
      rho.begin(), rho.end(), [](const auto& a, const auto& b) { return a.value < b.value; });
  EXPECT_GT(densest->value, 1.55);  // the ball is still there,
  EXPECT_EQ(densest->level, 2);     // on the finest level
}

}  // namespace
}  // namespace sluice::verification::amr_uniform_flow_test
