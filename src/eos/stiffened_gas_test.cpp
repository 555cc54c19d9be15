// Stiffened gas: every check of a law, and a shock in stiff_water.
#include "eos/stiffened_gas.hpp"

#include "eos/eos_test_support.hpp"

namespace sluice::eos::stiffened_gas_test {
namespace {

TEST(StiffenedGas, IsConsistent) {
  check_law(stiff_water, {10.0, 5e3, 10.0, 5e3});
  check_extremes(stiff_water, 1e3, 1e7);
}

TEST(StiffenedGas, AllowsTensionDownToMinusPinf) {
  const double rho = 1e3;
  EXPECT_TRUE(stiff_water.admissible(rho, stiff_water.energy_from_pressure(rho, -0.999 * 6e8)));
  EXPECT_FALSE(stiff_water.admissible(rho, stiff_water.energy_from_pressure(rho, -1.001 * 6e8)));
}

// Two bodies of water meet at 100 m/s each: exact solution of the Riemann problem, 8 digits.
TEST(StiffenedGas, MeetsTheHugoniotOfWaterImpact) {
  const double p0 = 1e5, rho0 = 1e3, p1 = 1.7665413e8, rho1 = 1060.0405, shock = 1665.54;
  const double e0 = stiff_water.energy_from_pressure(rho0, p0) / rho0;
  const double e1 = stiff_water.energy_from_pressure(rho1, p1) / rho1;
  EXPECT_NEAR(e1 - e0, 0.5 * (p0 + p1) * (1.0 / rho0 - 1.0 / rho1), 1e-5 * (e1 - e0));
  EXPECT_NEAR(rho0 * (shock + 100.0) * 100.0, p1 - p0, 1e-5 * p1);
}

}  // namespace
}  // namespace sluice::eos::stiffened_gas_test
