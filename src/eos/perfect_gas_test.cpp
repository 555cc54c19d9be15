// Thermally perfect gas: every check of a law with the heat of air and of products.
#include "eos/perfect_gas.hpp"

#include "eos/eos_test_support.hpp"

namespace sluice::eos::perfect_gas_test {
namespace {

TEST(PerfectGas, IsConsistentWithTheHeatOfAir) {
  const PerfectGas<Nasa7Heat> warm = warm_air();
  check_law(warm, {1e-6, 1e3, 20.0, 198.0});
  check_law(warm, {1e-6, 1e3, 202.0, 990.0});
  check_law(warm, {1e-6, 1e3, 1010.0, 5.9e3});
  check_law(warm, {1e-6, 1e3, 6.1e3, 1e5});
  check_extremes(warm, 1.2, 2e5);
}

TEST(PerfectGas, IsConsistentWithAPolynomialHeat) {
  const PerfectGas<PolynomialHeat> gas = fitted_gas();
  check_law(gas, {1e-6, 1e3, 360.0, 4.9e3});
  check_extremes(gas, 1.0, 1e6);
}

TEST(PerfectGas, IsTheIdealGasWhereHeatIsConstant) {
  const PerfectGas<ConstantHeat> gas{.gas_constant = 287.0, .heat = {717.5}};
  EXPECT_DOUBLE_EQ(gas.pressure(1.3, 2e5), air.pressure(1.3, 2e5));
  EXPECT_DOUBLE_EQ(gas.sound_speed(1.3, 1e5), air.sound_speed(1.3, 1e5));
}

// A strong shock heats air less than constant specific heats would.
TEST(PerfectGas, LosesHeatToVibration) {
  const PerfectGas<Nasa7Heat> warm = warm_air();
  EXPECT_NEAR(warm.gamma(300.0), 1.40, 0.002);
  EXPECT_NEAR(warm.gamma(1000.0), 1.336, 0.002);
  EXPECT_NEAR(warm.gamma(3000.0), 1.29, 0.01);
}

}  // namespace
}  // namespace sluice::eos::perfect_gas_test
