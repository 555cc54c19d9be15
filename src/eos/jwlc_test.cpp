// JWL isentrope: every check of a law, and the same state as the full JWL.
#include "eos/jwlc.hpp"

#include "eos/eos_test_support.hpp"

namespace sluice::eos {
namespace {

const Jwlc tnt{{.A = 371.2e9,
                .B = 3.231e9,
                .C = 1.045e9,
                .R1 = 4.15,
                .R2 = 0.95,
                .om = 0.30,
                .rho0 = 1630.0,
                .specific_heat = 1000.0}};

TEST(Jwlc, IsConsistent) {
  check_law(tnt, {1e-3, 4e3, 300.0, 1e4}, {.slopes = 1e-8, .mixed = 1e-8});
  check_extremes(tnt, 1630.0, 1e7);
}

TEST(Jwlc, PassesThroughTheChapmanJouguetStateOfTnt) {  // 21 GPa, 6930 m/s (UCRL-52997)
  const double p = 21e9, V = 1.0 - p / (1630.0 * 6930.0 * 6930.0), rho = 1630.0 / V;
  EXPECT_NEAR(tnt.pressure(rho, 0.0), p, 0.005 * p);
  EXPECT_NEAR(p / (1630.0 * 6930.0) + tnt.sound_speed(rho, p), 6930.0, 0.02 * 6930.0);
}

// On an isentrope of the full law the energy above its cold curve falls like rho^om.
TEST(Jwlc, IsAnIsentropeOfTheFullLaw) {
  const Jwl full{{.A = 371.2e9,
                  .B = 3.231e9,
                  .R1 = 4.15,
                  .R2 = 0.95,
                  .om = 0.30,
                  .rho0 = 1630.0,
                  .specific_heat = 1000.0}};
  for (double rho = 1.0; rho < 3e3; rho *= 1.5) {
    const double E = rho * tnt.cold_energy(rho);
    EXPECT_NEAR(full.pressure(rho, E), tnt.pressure(rho, E), 1e-12 * tnt.pressure(rho, E));
    EXPECT_NEAR(full.sound_speed_squared(rho, E), tnt.sound_speed_squared(rho, E),
                1e-12 * tnt.sound_speed_squared(rho, E));
  }
}

}  // namespace
}  // namespace sluice::eos
