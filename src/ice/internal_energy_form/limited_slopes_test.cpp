// The limiter of the classic form against values found by hand.
#include "ice/internal_energy_form/limited_slopes.hpp"

#include <gtest/gtest.h>

namespace sluice::ice::internal_energy_form::limited_slopes_test {
namespace {

const MassSlopes<1> unweighted_1d;
const MassSlopes<2> unweighted_2d;

TEST(ClassicLimiter, LeavesALinearProfileAlone) {
  EXPECT_EQ((limiter_of_cell<1, false>(2.0, {1.0}, {3.0}, {1.0}, unweighted_1d)), 1.0);
}

TEST(ClassicLimiter, FlattensExtrema) {
  EXPECT_EQ((limiter_of_cell<1, false>(3.0, {1.0}, {2.0}, {0.5}, unweighted_1d)), 0.0);
  EXPECT_EQ((limiter_of_cell<1, false>(-1.0, {0.0}, {0.5}, {0.25}, unweighted_1d)), 0.0);
}

TEST(ClassicLimiter, KeepsCornersWithinTheNeighbours) {
  // q = 1 between 0.9 and 5: the corner at 1 - 1.025 must not fall below 0.9, 0.1/1.025 is left.
  const double s = 0.5 * (5.0 - 0.9);
  EXPECT_DOUBLE_EQ((limiter_of_cell<1, false>(1.0, {0.9}, {5.0}, {s}, unweighted_1d)),
                   0.1 / (0.5 * s));
  // Two axes: corners at q -+ (s_x + s_y)/2 = 1 -+ 1.1, bounds 0 and 3.
  EXPECT_DOUBLE_EQ(
      (limiter_of_cell<2, false>(1.0, {0.0, 0.9}, {3.0, 1.3}, {1.5, 0.7}, unweighted_2d)),
      1.0 / 1.1);
}

TEST(ClassicLimiter, IsOddUnderChangeOfSign) {
  const double phi =
      limiter_of_cell<2, false>(1.0, {0.0, 0.9}, {3.0, 1.3}, {1.5, 0.7}, unweighted_2d);
  EXPECT_EQ((limiter_of_cell<2, false>(-1.0, {-3.0, -1.3}, {0.0, -0.9}, {1.5, 0.7}, unweighted_2d)),
            phi);
}

// However small the differences: S of the quotients must not tell up from down.
TEST(ClassicLimiter, IsOddWhereDifferencesAreTiny) {
  for (const double d : {0.0, 1e-200, 1e-150, 3e-101, 1e-100, 2e-99, 1e-90}) {
    const double phi = limiter_of_cell<1, false>(d, {0.0}, {1.0}, {0.5}, unweighted_1d);
    EXPECT_EQ((limiter_of_cell<1, false>(-d, {-1.0}, {0.0}, {0.5}, unweighted_1d)), phi) << d;
    EXPECT_LE(phi, 1.0);
  }
}

TEST(ClassicLimiter, WeightsCornersWithTheirDensity) {
  // rho = 1 +- 0.5: the light corner's deviation doubles, 1 - 2 (0.5) = 0 against a bound of 0.5.
  MassSlopes<1> mass;
  mass.rho = 1.0;
  mass.slope[0] = 1.0;
  EXPECT_DOUBLE_EQ((limiter_of_cell<1, true>(1.0, {0.5}, {1.5}, {1.0}, mass)), 0.5);
  EXPECT_DOUBLE_EQ((limiter_of_cell<1, false>(1.0, {0.5}, {1.5}, {1.0}, mass)), 1.0);
}

}  // namespace
}  // namespace sluice::ice::internal_energy_form::limited_slopes_test
