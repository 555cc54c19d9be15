// Six Riemann problems against their exact solution: mean density error over the cells, gamma 1.4.
//
// The limits are 1.25 times the errors of a second-order Godunov code (VL2, PLM, HLLC) at the same
// resolution, CFL 0.4; at CFL 0.05 the error may be 1.3 times that at 0.4. The other code's errors
// are those from the exact values at the centres of cells, and so are ours here.
#include <gtest/gtest.h>

#include "verification/case_run.hpp"

namespace sluice::verification::riemann_problems_test {
namespace {

struct Limits {
  const char* deck;
  double godunov_200, godunov_800;  // the other code's errors
};
constexpr double allowed_share = 1.25;
constexpr double allowed_small_cfl_ratio = 1.3;
// Behind each row what was measured here: errors at N = 200 and 800 in units of the other code's,
// and the error at CFL 0.05 in units of that at 0.4.
const Limits all_limits[] = {
    {"riemann_sod", 2.59e-3, 8.2e-4},            // 1.228  1.087  0.98
    {"riemann_123", 4.46e-3, 1.43e-3},           // 1.045  1.152  0.63
    {"riemann_left_blast", 8.55e-2, 2.34e-2},    // 0.808  0.803  1.03
    {"riemann_right_blast", 7.94e-2, 2.57e-2},   // 0.804  0.795  1.03
    {"riemann_two_shocks", .247, .0925},         // 0.916  0.782  1.10
    {"riemann_slow_contact", 3.13e-2, 4.76e-3},  // 1.151  1.120  1.15
};

class RiemannProblem : public testing::TestWithParam<Limits> {
 protected:
  static double density_error(const CaseRun& run) {
    EXPECT_GT(lowest(run.field("rho_CC")), 0);
    EXPECT_GT(lowest(run.field("press_CC")), 0);
    EXPECT_GT(lowest(run.field("temp_CC")), 0);
    return run.error_at_centres("rho_CC").l1;
  }
};

TEST_P(RiemannProblem, ErrorIsThatOfAGoodGodunovCode) {
  const Limits& limits = GetParam();
  const double coarse = density_error(CaseRun(limits.deck, {resolution(200)}));
  const double fine = density_error(CaseRun(limits.deck, {resolution(800)}));
  record("n200", coarse / limits.godunov_200);
  record("n800", fine / limits.godunov_800);
  EXPECT_LE(coarse, allowed_share * limits.godunov_200) << coarse / limits.godunov_200;
  EXPECT_LE(fine, allowed_share * limits.godunov_800) << fine / limits.godunov_800;
}

TEST_P(RiemannProblem, SmallStepsDoNotCostAccuracy) {
  const Limits& limits = GetParam();
  const double usual = density_error(CaseRun(limits.deck, {resolution(200), "CFD/cfl=0.4"}));
  const double small = density_error(CaseRun(limits.deck, {resolution(200), "CFD/cfl=0.05"}));
  record("ratio", small / usual);
  EXPECT_LE(small, allowed_small_cfl_ratio * usual) << small / usual;
}

INSTANTIATE_TEST_SUITE_P(Six, RiemannProblem, testing::ValuesIn(all_limits),
                         [](const auto& test) { return std::string(test.param.deck).substr(8); });

}  // namespace
}  // namespace sluice::verification::riemann_problems_test
