// TST: every check of a law, and van der Waals' critical point (u = w = 0).
#include "eos/tst.hpp"

#include "eos/eos_test_support.hpp"

namespace sluice::eos::tst_test {
namespace {

TEST(TstGas, IsConsistent) {  // propellant gas of the decks, and a gas that attracts
  const TstGas repelling{
      {.a = -260.1385968, .b = 7.955153678e-4, .Gamma = 1.63, .specific_heat = 1500.0}};
  check_law(repelling, {1e-3, 1100.0, 250.0, 5e3}, {.slopes = 2e-8, .mixed = 2e-8});
  check_extremes(repelling, 1.0, 1e6);
  check_law(attracting_gas, {1e-3, 900.0, 600.0, 5e3}, {.slopes = 2e-8, .mixed = 2e-8});
  check_extremes(attracting_gas, 1.0, 1e6);
}

// Tc = 8a/(27 R b), pc = a/(27 b^2), vc = 3b, where the three roots meet.
TEST(TstGas, HasTheCriticalPointOfVanDerWaals) {
  const double a = 200.0, b = 1e-3, R = 400.0;
  const TstGas gas{{.a = a, .b = b, .u = 0.0, .w = 0.0, .Gamma = 1.4, .specific_heat = 1000.0}};
  const double pc = a / (27 * b * b), Tc = 8 * a / (27 * R * b), rho_c = 1.0 / (3.0 * b);
  EXPECT_NEAR(gas.pressure(rho_c, gas.energy_from_temperature(rho_c, Tc)), pc, 1e-12 * pc);
  EXPECT_NEAR(gas.density(pc, Tc), rho_c, 1e-4 * rho_c);  // a triple root: cube root of round-off
}

// The reference's own constants (u = -1/2, w = 3): b = 2/27 RTc/pc, a = .470507 (RTc)^2/pc,
// vc = 4b.
TEST(TstGas, HasTheCriticalPointOfItsReference) {
  const double b = 1e-3, R = 400.0, Tc = 500.0, pc = R * Tc * 2.0 / (27.0 * b), rho_c = 0.25 / b;
  const double a = 0.470507 * R * Tc * R * Tc / pc;
  const TstGas gas{{.a = a, .b = b, .Gamma = 1.4, .specific_heat = 1000.0}};
  const auto p = [&](double rho) {
    return gas.pressure(rho, gas.energy_from_temperature(rho, Tc));
  };
  EXPECT_NEAR(p(rho_c), pc, 1e-5 * pc);
  EXPECT_NEAR(slope_of(p, rho_c, 1e-3 * rho_c), 0.0, 1e-4 * pc / rho_c);
}

TEST(TstGas, TakesTheGasWhereGasAndLiquidAreBothPossible) {
  const double a = 200.0, b = 1e-3, Tc = 8 * a / (27 * 400.0 * b), T = 0.85 * Tc;
  const TstGas gas{{.a = a, .b = b, .u = 0.0, .w = 0.0, .Gamma = 1.4, .specific_heat = 1000.0}};
  const double p = 0.5 * a / (27 * b * b);  // near the saturation pressure: three roots
  const double rho = gas.density(p, T);
  EXPECT_LT(rho, 0.5 / (3.0 * b));
  EXPECT_NEAR(gas.pressure(rho, gas.energy_from_temperature(rho, T)), p, 1e-12 * p);
  EXPECT_TRUE(gas.admissible(rho, gas.energy_from_temperature(rho, T)));
  const double middle = 1.2 / (3.0 * b);  // at the spinodal
  EXPECT_FALSE(gas.admissible(middle, gas.energy_from_temperature(middle, 0.5 * Tc)));
  EXPECT_TRUE(std::isnan(gas.density(-1e5, T)));
}

}  // namespace
}  // namespace sluice::eos::tst_test
