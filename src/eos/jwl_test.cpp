// JWL: every check of a law, and the Chapman-Jouguet states of two explosives.
#include "eos/jwl.hpp"

#include "eos/eos_test_support.hpp"

namespace sluice::eos::jwl_test {
namespace {

// Dobratz and Crawford, LLNL Explosives Handbook, UCRL-52997 (1985); E0 in J/m^3.
struct Explosive {
  Jwl products;
  double E0, p_cj, D;
};
const Explosive hmx{{{.A = 778.3e9,
                      .B = 7.071e9,
                      .R1 = 4.2,
                      .R2 = 1.0,
                      .om = 0.30,
                      .rho0 = 1891.0,
                      .specific_heat = 1200.0}},
                    10.5e9,
                    42e9,
                    9110.0};
const Explosive trotyl{tnt, 7.0e9, 21e9, 6930.0};

TEST(Jwl, IsConsistent) {
  check_law(hmx.products, {1e-3, 4e3, 300.0, 1e4}, {.slopes = 1e-8, .mixed = 1e-8});
  check_extremes(hmx.products, 1891.0, 1e7);
}

TEST(Jwl, IsConsistentWithNegativeB) {  // unreacted LX-17: cold curve below zero pressure
  const Jwl solid{{.A = 778.1e11,
                   .B = -5.031e9,
                   .R1 = 11.3,
                   .R2 = 1.13,
                   .om = 0.8938,
                   .rho0 = 1905.0,
                   .specific_heat = 2.487e6 / 1905.0}};
  check_law(solid, {1850.0, 4e3, 250.0, 3e3}, {.slopes = 2e-8, .mixed = 2e-8});
  check_extremes(solid, 1905.0, 1e6);
  EXPECT_NEAR(solid.density(101325.0, 298.0), 1905.0, 5.0);
  EXPECT_LT(solid.lowest_pressure(), 0.0);
  double lowest = 0.0;
  for (double rho = 800.0; rho < 2500.0; rho += 1.0)
    lowest = std::min(lowest, solid.pressure(rho, rho * solid.cold_energy(rho)));
  EXPECT_NEAR(lowest, solid.lowest_pressure(), 1e-5 * std::abs(lowest));
}

// Behind a steady detonation: mass and momentum give V, the Hugoniot gives e, and D = u + c.
// (D is published to three digits: 0.3 % of D moves p by 1 %.)
TEST(Jwl, GivesChapmanJouguetStates) {
  for (const Explosive& x : {hmx, trotyl}) {
    const double rho0 = x.products.rho0, V = 1.0 - x.p_cj / (rho0 * x.D * x.D), rho = rho0 / V;
    const double E = (x.E0 + 0.5 * x.p_cj * (1.0 - V)) / V;
    EXPECT_NEAR(x.products.pressure(rho, E), x.p_cj, 0.03 * x.p_cj);
    const double u = x.p_cj / (rho0 * x.D);
    EXPECT_NEAR(u + std::sqrt(x.products.sound_speed_squared(rho, E)), x.D, 0.02 * x.D);
  }
}

TEST(Jwl, FindsTheDensityOfAnyPressureAndTemperature) {
  for (double p = 1.0; p < 1e13; p *= 7.0)
    for (const double T : {30.0, 300.0, 3e4}) {
      const double rho = tnt.density(p, T);
      const double back = tnt.pressure(rho, tnt.energy_from_temperature(rho, T));
      EXPECT_NEAR(back, p, 1e-12 * p) << p << ' ' << T;
    }
}

}  // namespace
}  // namespace sluice::eos::jwl_test
