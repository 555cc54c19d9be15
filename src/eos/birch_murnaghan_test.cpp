// Birch-Murnaghan: every check of a law, and its slope of the bulk modulus.
#include "eos/birch_murnaghan.hpp"

#include "eos/eos_test_support.hpp"

namespace sluice::eos::birch_murnaghan_test {
namespace {

TEST(BirchMurnaghan, IsConsistent) {
  for (const double n : {3.5, 4.0, 6.0}) {
    const BirchMurnaghan solid{{.n = n, .K = 7e-11, .rho0 = 2e3, .specific_heat = 900.0}};
    check_law(solid, {2e3, 4e3, 100.0, 5e3, 2e3}, {.slopes = 1e-8});
    check_extremes(solid, 2e3, 1e6);
  }
  const BirchMurnaghan soft{
      {.n = 5.0, .K = 1e-6, .rho0 = 500.0, .P0 = 1e5, .specific_heat = 1000.0}};
  check_law(soft, {126.0, 5e3, 100.0, 5e3, 500.0}, {.slopes = 1e-8, .mixed = 1e-8});
  check_law(soft, {5.0, 125.0, 100.0, 5e3}, {.slopes = 1e-8, .mixed = 1e-8});  // dust
}

TEST(BirchMurnaghan, HasBulkModulusSlopeNAtRest) {
  for (const double n : {3.0, 4.0, 5.5}) {
    const BirchMurnaghan solid{{.n = n, .K = 1e-10, .rho0 = 2e3, .P0 = 1e5, .specific_heat = 1.0}};
    const auto K = [&](double p) { return solid.bulk_modulus(solid.density(p, 300.0), p); };
    EXPECT_NEAR(K(1e5), 1e10, 1.0);
    EXPECT_NEAR((K(1.1e6) - K(1e5)) / 1e6, n, 1e-2);
  }
}

TEST(BirchMurnaghan, EndsWhereASoftSolidTurnsOver) {
  const BirchMurnaghan soft{{.n = 3.0, .K = 1e-10, .rho0 = 2e3, .specific_heat = 900.0}};
  EXPECT_TRUE(soft.admissible(4e3, 4e3 * (soft.cold_energy(4e3) + 1e5)));
  EXPECT_FALSE(soft.admissible(2e4, 2e4 * (soft.cold_energy(2e4) + 1e5)));
  EXPECT_TRUE(std::isnan(soft.density(1e13, 300.0)));
}

}  // namespace
}  // namespace sluice::eos::birch_murnaghan_test
