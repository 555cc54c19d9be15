// The radial Godunov code against the exact solution of a shock tube, and what it refuses.
#include "exact/radial/radial_euler.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "exact/test_support/radial_test_support.hpp"
#include "framework/base/error.hpp"

namespace sluice::exact::radial_euler_test {
namespace {

// Measured 2.44e-3 (N = 200) and 7.32e-4 (N = 800); a second-order Godunov code
// has 2.59e-3, 8.2e-4.
TEST(RadialEuler, PlaneShockTubeConvergesToTheExactSolution) {
  const double coarse = sod_error<RadialEuler>(200, 200), fine = sod_error<RadialEuler>(800, 800);
  EXPECT_LT(coarse, 2.7e-3);
  EXPECT_LT(fine, 8.2e-4);
  EXPECT_GT(std::log2(coarse / fine) / 2, .8);
}

TEST(RadialEuler, RefusesProblemsWithoutSense) {
  RadialProblem problem = sod(100, 3);
  problem.low = .1;
  EXPECT_THROW(RadialEuler{problem}, InputError);
  problem = sod(2, 1);
  EXPECT_THROW(RadialEuler{problem}, InputError);
  problem = sod(100, 1);
  problem.pieces[1].pressure = 0;
  EXPECT_THROW(RadialEuler{problem}, InputError);
}

}  // namespace
}  // namespace sluice::exact::radial_euler_test
