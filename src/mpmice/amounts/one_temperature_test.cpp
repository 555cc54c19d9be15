// Fluids of a cell that take one temperature: the sum of their energies, and when there is none.
#include "mpmice/amounts/one_temperature.hpp"

#include <gtest/gtest.h>

namespace sluice::mpmice::one_temperature_test {
namespace {

const std::vector<ice::Fluid> gases = {ice::ideal_gas(1.2, 3000), ice::ideal_gas(1.4, 717.5)};

// E = sum M cv T: T = 400000/(0.26 3000 + 0.001 717.5).
TEST(OneTemperature, MendsATraceBelowItsLeastEnergyAndKeepsTheSum) {
  const double M[] = {0.26, 1e-3}, V[] = {0.9999, 1e-4};
  double E[] = {400200, -200};
  ASSERT_TRUE(take_one_temperature(gases, M, V, E));
  EXPECT_NEAR(E[0] + E[1], 400000, 1e-12 * 400000);
  const double T = 400000 / (0.26 * 3000 + 1e-3 * 717.5);
  EXPECT_NEAR(E[0] / (0.26 * 3000), T, 1e-10 * T);
  EXPECT_NEAR(E[1] / (1e-3 * 717.5), T, 1e-10 * T);
}

TEST(OneTemperature, IsNoneWhereAllTogetherHaveNone) {
  const double M[] = {0.26, 1e-3}, V[] = {0.9999, 1e-4};
  double E[] = {100, -200};
  EXPECT_FALSE(take_one_temperature(gases, M, V, E));
  EXPECT_EQ(E[0], 100);
  EXPECT_EQ(E[1], -200);
}

TEST(OneTemperature, LeavesOutWhatIsAbsent) {
  const double M[] = {0.26, 0}, V[] = {1, 0};
  double E[] = {100, 0};
  EXPECT_TRUE(take_one_temperature(gases, M, V, E));
  EXPECT_EQ(E[1], 0);
}

}  // namespace
}  // namespace sluice::mpmice::one_temperature_test
