// Shock tubes of a liquid, a solid and products of detonation against the exact Riemann solution of
// their own equation of state.
#include <gtest/gtest.h>

#include "verification/case_run.hpp"

namespace sluice::verification::liquid_and_solid_tubes_test {
namespace {

struct Tube {
  const char* deck;
  double density_error;  // mean |rho - exact| at N = 200, kg/m^3
};
// 1.1 times what was measured, from means over cells: 1.698, 6.050, 0.4035, 1.25; at N = 800 0.28,
// 0.28, 0.21, 0.34 of it.
const Tube tubes[] = {{"water_shock_tube", 1.87},
                      {"jwl_products", 6.66},
                      {"murnaghan_shock_tube", 0.444},
                      {"noble_abel_tube", 1.38}};
constexpr double allowed_share_at_800 = 0.4;

class MaterialTube : public testing::TestWithParam<Tube> {};

TEST_P(MaterialTube, FollowsTheExactSolution) {
  const Tube& tube = GetParam();
  const CaseRun run(tube.deck);
  const double coarse = run.error("rho_CC").l1;
  const double fine = CaseRun(tube.deck, {resolution(800)}).error("rho_CC").l1;
  record("n200", coarse);
  record("share_at_800", fine / coarse);
  EXPECT_LE(coarse, tube.density_error);
  EXPECT_LE(fine, allowed_share_at_800 * coarse);
  EXPECT_LE(run.worst_drift(), 1e-13);
  EXPECT_GT(lowest(run.field("temp_CC")), 0);
}

INSTANTIATE_TEST_SUITE_P(All, MaterialTube, testing::ValuesIn(tubes),
                         [](const auto& test) { return std::string(test.param.deck); });

// Vibration takes part of the heat. Measured behind the shock: 1283 K, 1343 K without.
TEST(HotAir, IsColderBehindTheShockThanWithAConstantHeat) {
  const CaseRun hot("hot_air_shock_tube");
  const CaseRun constant("hot_air_shock_tube",
                         {"MaterialProperties/ICE/material/SpecificHeatModel="});
  record("hottest", highest(hot.field("temp_CC")));
  record("hottest_constant", highest(constant.field("temp_CC")));
  const auto behind = [](const CaseRun& run) {  // hottest cell of the shocked air
    const CellValues T = run.field("temp_CC"), u = run.field("vel_CC");
    int front = 199;
    while (front > 0 && u.at(front) < 0.5 * highest(u)) --front;
    return T.at(front - 8);
  };
  record("behind", behind(hot));
  record("behind_constant", behind(constant));
  EXPECT_LT(behind(hot), 0.97 * behind(constant));
}

}  // namespace
}  // namespace sluice::verification::liquid_and_solid_tubes_test
