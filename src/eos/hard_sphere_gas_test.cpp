// Hard-sphere gas: every check of a law, and its two limits.
#include "eos/hard_sphere_gas.hpp"

#include "eos/eos_test_support.hpp"

namespace sluice::eos::hard_sphere_gas_test {
namespace {

TEST(HardSphereGas, IsConsistent) {
  check_law(hard_spheres, {1e-4, 950.0, 100.0, 1e4, 0.0, 1e-4});
  check_extremes(hard_spheres, 1.0, 1e6);
  EXPECT_FALSE(hard_spheres.admissible(1000.0, 1e9));
  EXPECT_LT(hard_spheres.density(1e15, 300.0), 1000.0);
}

TEST(HardSphereGas, IsAnIdealGasWithoutCovolume) {
  const HardSphereGas gas{{.gamma = 1.4, .b = 0.0, .specific_heat = 717.5}};
  EXPECT_DOUBLE_EQ(gas.pressure(3.0, 7e5), air.pressure(3.0, 7e5));
  EXPECT_DOUBLE_EQ(gas.density(1e5, 300.0), air.density(1e5, 300.0));
  EXPECT_TRUE(gas.admissible(1e6, 1e9));
}

}  // namespace
}  // namespace sluice::eos::hard_sphere_gas_test
