// Noble-Abel stiffened gas: every check of a law, its two limits, a saturated liquid.
#include "eos/noble_abel_stiffened_gas.hpp"

#include "eos/eos_test_support.hpp"

namespace sluice::eos::noble_abel_stiffened_gas_test {
namespace {

TEST(NobleAbelStiffenedGas, IsConsistent) {
  check_law(repulsive_water, {10.0, 1.4e3, 200.0, 3e3, 0.0, 1e-4});
  check_extremes(repulsive_water, 1e3, 1e6);
  EXPECT_FALSE(repulsive_water.admissible(1600.0, 1e9));
  EXPECT_LT(repulsive_water.density(1e15, 300.0), 1.0 / 6.61e-4);
}

TEST(NobleAbelStiffenedGas, IsAStiffenedGasWithoutCovolume) {
  const NobleAbelStiffenedGas law{
      {.gamma = 4.4, .pinf = 6e8, .b = 0.0, .q = -1.2e6, .specific_heat = 1816.0}};
  for (const double rho : {900.0, 1000.0, 1200.0}) {
    const double E = stiff_water.energy_from_temperature(rho, 350.0);
    EXPECT_NEAR(law.pressure(rho, E), stiff_water.pressure(rho, E), 1e-12 * 6e8 * 4.4);
    EXPECT_NEAR(law.sound_speed_squared(rho, E), stiff_water.sound_speed_squared(rho, E), 1e-4);
    EXPECT_NEAR(law.temperature(rho, E), 350.0, 1e-9);
  }
}

TEST(NobleAbelStiffenedGas, IsAHardSphereGasWithoutExtraPressure) {
  const NobleAbelStiffenedGas law{{.gamma = 1.3, .b = 1e-3, .specific_heat = 1100.0}};
  for (const double rho : {1.0, 100.0, 900.0}) {
    const double E = hard_spheres.energy_from_temperature(rho, 500.0);
    EXPECT_DOUBLE_EQ(law.pressure(rho, E), hard_spheres.pressure(rho, E));
    EXPECT_DOUBLE_EQ(law.density(1e7, 500.0), hard_spheres.density(1e7, 500.0));
  }
}

// Le Metayer and Saurel (2016): constants of liquid water fitted from 300 to 500 K, whose density
// at saturation, 0.1 MPa and 373 K, is 958 kg/m^3 by measurement.
TEST(NobleAbelStiffenedGas, HasTheDensityOfHotWater) {
  EXPECT_NEAR(repulsive_water.density(1.013e5, 373.15), 958.0, 0.02 * 958.0);
}

}  // namespace
}  // namespace sluice::eos::noble_abel_stiffened_gas_test
