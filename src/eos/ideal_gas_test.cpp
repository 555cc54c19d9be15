// Ideal gas: every check of a law, and air.
#include "eos/ideal_gas.hpp"

#include "eos/eos_test_support.hpp"

namespace sluice::eos::ideal_gas_test {
namespace {

TEST(IdealGas, IsConsistent) {
  check_law(air, {1e-6, 1e4, 1.0, 1e5});
  check_extremes(air, 1.2, 2e5);
}

TEST(IdealGas, GivesTheSoundSpeedOfAir) {  // 331.3 m/s at 0 C (R = 287.05)
  const IdealGas dry{.gamma = 1.4, .specific_heat = 717.63};
  const double rho = dry.density(101325.0, 273.15);
  EXPECT_NEAR(rho, 1.2925, 1e-3);
  EXPECT_NEAR(dry.sound_speed(rho, 101325.0), 331.3, 0.2);
}

}  // namespace
}  // namespace sluice::eos::ideal_gas_test
