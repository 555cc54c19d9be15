// Murnaghan: every check of a law, and water at high pressure.
#include "eos/murnaghan.hpp"

#include "eos/eos_test_support.hpp"

namespace sluice::eos::murnaghan_test {
namespace {

TEST(Murnaghan, IsConsistentInCompression) {
  check_law(steep_solid, {1160.0, 4e3, 100.0, 5e3, 1160.0}, {.slopes = 1e-8});
  check_extremes(steep_solid, 1160.0, 1e6);
}

// Expanded: p falls with the power 1/(K P0) of the density, so the states lie close to rho0.
TEST(Murnaghan, IsConsistentInExpansion) {
  check_law(steep_solid, {1159.4, 1159.999, 100.0, 5e3, 0.0, 1e-7, 0.9},
            {.slopes = 2e-7, .density = 1e-11, .mixed = 2e-7});
  const Murnaghan soft{{.n = 2.0, .K = 1e-6, .rho0 = 500.0, .P0 = 1e5, .specific_heat = 1000.0}};
  check_law(soft, {126.0, 5e3, 100.0, 5e3, 500.0}, {.slopes = 1e-8, .mixed = 1e-8});
  check_law(soft, {5.0, 125.0, 100.0, 5e3}, {.slopes = 1e-8, .mixed = 1e-8});  // dust
}

// Torn, a solid is dust: a state however thin.
TEST(Murnaghan, IsConsistentWhenTorn) {
  check_law(steep_solid, {1e-6, 1159.0, 100.0, 5e3, 0.0}, {.slopes = 1e-8, .mixed = 1e-8});
  for (const double rho : {1e-200, 1e-12, 1.0, 1e3}) {
    const double p = steep_solid.pressure(rho, 1e5 * rho);
    EXPECT_GT(p, 0.0);
    EXPECT_GT(steep_solid.bulk_modulus(rho, p), 0.0);
    EXPECT_TRUE(steep_solid.admissible(rho, 1e5 * rho));
  }
  // Continuous where the power law ends.
  const double x = std::pow(1e-6, 39e-11 * 101325), rho = 1160 * x;
  EXPECT_NEAR(steep_solid.pressure(rho * (1 + 1e-12), 0), 0.101325, 1e-6);
  EXPECT_NEAR(steep_solid.pressure(rho * (1 - 1e-12), 0), 0.101325, 1e-6);
}

TEST(Murnaghan, IsSmoothAtRestDensityAndStiffensWithN) {
  const Murnaghan solid{{.n = 7.0, .K = 1e-10, .rho0 = 2e3, .P0 = 1e5, .specific_heat = 1.0}};
  EXPECT_NEAR(solid.pressure(2e3, 0.0), 1e5, 1e-6);
  EXPECT_NEAR(solid.bulk_modulus(2e3, 1e5), 1e10, 1e-2);
  EXPECT_NEAR(solid.bulk_modulus(2e3 * (1 - 1e-12), 1e5), 1e10, 1e4);
  const auto K = [&](double p) { return solid.bulk_modulus(solid.density(p, 300.0), p); };
  EXPECT_NEAR((K(2e8) - K(1e8)) / 1e8, 7.0, 1e-9);  // Murnaghan's assumption
}

// IAPWS-95 (2018 release, table 7), 300 K: 1005.308 kg/m^3 at 20.0022515 MPa, 1188.202 at
// 700.004704.
TEST(Murnaghan, ReachesThePressuresOfWater) {
  const Murnaghan water{{.n = 6.0,
                         .K = 1.0 / 2.22e9,
                         .rho0 = 996.556,
                         .P0 = 0.0992418352e6,
                         .specific_heat = 4130.0}};
  EXPECT_NEAR(water.pressure(1005.308, 0.0), 20.0022515e6, 0.01 * 20e6);
  EXPECT_NEAR(water.pressure(1188.202, 0.0), 700.004704e6, 0.02 * 700e6);
}

}  // namespace
}  // namespace sluice::eos::murnaghan_test
