// Thomsen-Hartka water: every check of a law, and water of 300 K.
#include "eos/thomsen_hartka_water.hpp"

#include "eos/eos_test_support.hpp"

namespace sluice::eos::thomsen_hartka_water_test {
namespace {

const ThomsenHartkaWater water;

TEST(ThomsenHartkaWater, IsConsistent) {  // on the warm side, x > 0
  check_law(water, {985.0, 1035.0, 285.0, 315.0, 0.0, 3e-4},
            {.slopes = 2e-7, .energy = 1e-11, .mixed = 2e-7});
  check_extremes(water, 1000.0, 1e5);
}

// IAPWS-95 (2018 release, table 7), 300 K: 996.556 kg/m^3 at 0.0992418352 MPa, c 1501.5 m/s,
// cv 4130; 1005.308 at 20.0022515 MPa.
TEST(ThomsenHartkaWater, IsWater) {
  EXPECT_NEAR(water.density(0.0992418352e6, 300.0), 996.556, 0.001 * 996.556);
  EXPECT_NEAR(water.density(20.0022515e6, 300.0), 1005.308, 0.002 * 1005.308);
  const double rho = water.density(1e5, 300.0), E = water.energy_from_temperature(rho, 300.0);
  EXPECT_NEAR(std::sqrt(water.sound_speed_squared(rho, E)), 1501.5, 0.04 * 1501.5);
  const auto e = [&](double T) { return water.energy_from_temperature(rho, T) / rho; };
  EXPECT_NEAR(slope_of(e, 300.0, 0.1), 4130.0, 0.02 * 4130.0);
}

TEST(ThomsenHartkaWater, IsDensestWhereReferenceSays) {  // 4 C at no pressure, colder under it
  for (const double p : {0.0, 1e7}) {
    const double T = 277.0 - 2e-7 * p;
    EXPECT_GT(water.density(p, T), water.density(p, T + 0.5));
    EXPECT_GT(water.density(p, T), water.density(p, T - 0.5));
    const double rho = water.density(p, T), E = water.energy_from_temperature(rho, T);
    EXPECT_NEAR(water.dp_de(rho, E), 0.0, 1e-6);
    EXPECT_NEAR(water.temperature(rho, E), T, 1e-6);
  }
}

// At one density and pressure there is cold water (x < 0) and warm: temperature tells which.
TEST(ThomsenHartkaWater, HasAColdAndAWarmStateAtOneDensity) {
  for (const double p : {1e5, 1e7})
    for (const double away : {0.5, 5.0, 9.0}) {
      const double densest = water.To - water.a * p, cold = densest - away, warm = densest + away;
      const double rho = water.density(p, cold);
      EXPECT_NEAR(water.density(p, warm), rho, 1e-12 * rho);
      for (const double T : {cold, warm}) {
        const double E = water.energy_from_temperature(rho, T);
        EXPECT_NEAR(water.energy_from_pressure(rho, p, T), E, 1e-8 * rho * water.co);
        EXPECT_NEAR(water.pressure(rho, E), p, 1e-4);
        EXPECT_NEAR(modulus_of_state(water, rho, E, p), rho * water.sound_speed_squared(rho, E), 1);
        // The slope of the isentrope: K = rho dp/drho at e + p/rho^2 drho.
        const double step = 1e-6 * rho, e = E / rho, push = p / (rho * rho) * step;
        const auto at = [&](double r, double de) { return water.pressure(r, r * (e + de)); };
        const double K = rho * (at(rho + step, push) - at(rho - step, -push)) / (2 * step);
        EXPECT_NEAR(modulus_of_state(water, rho, E, p), K, 1e-5 * K);
      }
      EXPECT_EQ(water.energy_from_pressure(rho, p), water.energy_from_pressure(rho, p, warm));
    }
}

TEST(ThomsenHartkaWater, SaysWhereItEnds) {
  const double x_end = 0.5 * water.ko / (water.a * water.L);
  EXPECT_TRUE(std::isnan(water.density((x_end + 1.0) / water.a, water.To)));
  EXPECT_FALSE(water.admissible(1e3, 1e3 * 1e7));  // no liquid has this energy
  EXPECT_TRUE(std::isnan(water.temperature(1e3, 1e3 * 1e7)));
  const double rho = water.density(-1e7, 280.0);  // tension is legal
  EXPECT_TRUE(water.admissible(rho, water.energy_from_temperature(rho, 280.0)));
}

}  // namespace
}  // namespace sluice::eos::thomsen_hartka_water_test
