// What both radial codes, on a fixed grid and on one that moves with the gas, must do alike.
#include <gtest/gtest.h>

#include "exact/radial/radial_euler.hpp"
#include "exact/radial/radial_lagrangian.hpp"
#include "exact/test_support/radial_test_support.hpp"

namespace sluice::exact::radial_codes_test {
namespace {

template <class Code>
class RadialCode : public testing::Test {};
struct CodeNames {
  template <class Code>
  static std::string GetName(int) {
    return std::is_same_v<Code, RadialEuler> ? "Euler" : "Lagrangian";
  }
};
using Codes = testing::Types<RadialEuler, RadialLagrangian>;
TYPED_TEST_SUITE(RadialCode, Codes, CodeNames);

TYPED_TEST(RadialCode, KeepsMassAndEnergyWithinWalls) {
  for (int dimension : {1, 2, 3}) {
    TypeParam run(sod(200, dimension));
    const double mass = run.total_mass(), energy = run.total_energy();
    run.advance_to(.8);  // the shock has met the wall and come back
    EXPECT_NEAR(run.total_mass(), mass, 1e-13 * mass) << dimension;
    EXPECT_NEAR(run.total_energy(), energy, 1e-13 * energy) << dimension;
  }
}

TYPED_TEST(RadialCode, LeavesUniformGasAtRestInEverySymmetry) {
  for (int dimension : {1, 2, 3}) {
    RadialProblem problem;
    problem.dimension = dimension;
    problem.cells = 64;
    problem.pieces = {{1, 1.3, 0, .7}};
    TypeParam run(problem);
    run.advance_to(1);
    EXPECT_LT(std::abs(run.at(.01).velocity), 1e-13) << dimension;
    EXPECT_NEAR(run.at(.01).pressure, .7, 1e-13) << dimension;
  }
}

// Converging flow onto an axis: the plateau of Noh's problem, away from the heated axis, and the
// flow before the shock, which stands at 0.2 to within two cells.
TYPED_TEST(RadialCode, ReachesThePlateauOfCylindricalNoh) {
  RadialProblem problem;
  problem.dimension = 2;
  problem.gamma = 5. / 3;
  problem.high = 2;
  problem.outflow = true;
  problem.cells = 1600;
  problem.pieces = {{2, 1, -1, 1e-6}};
  TypeParam run(problem);
  run.advance_to(.6);
  EXPECT_NEAR(run.at(.1).density, 16, .16);
  EXPECT_NEAR(run.at(.1).pressure, 16. / 3, .06);
  EXPECT_NEAR(run.at(.4).density, 1 + .6 / .4, .01);
  EXPECT_GT(run.at(.2 - .003).density, 12);
  EXPECT_LT(run.at(.2 + .003).density, 8);
}

}  // namespace
}  // namespace sluice::exact::radial_codes_test
