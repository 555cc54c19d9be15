// JWL isentrope: every check of a law, and the same state as the full JWL.
#include "eos/jwlc.hpp"

#include "eos/eos_test_support.hpp"

namespace sluice::eos::jwlc_test {
namespace {

TEST(Jwlc, IsConsistent) {
  check_law(tnt_isentrope, {1e-3, 4e3, 300.0, 1e4}, {.slopes = 1e-8, .mixed = 1e-8});
  check_extremes(tnt_isentrope, 1630.0, 1e7);
}

TEST(Jwlc, PassesThroughTheChapmanJouguetStateOfTnt) {  // 21 GPa, 6930 m/s (UCRL-52997)
  const double p = 21e9, V = 1.0 - p / (1630.0 * 6930.0 * 6930.0), rho = 1630.0 / V;
  EXPECT_NEAR(tnt_isentrope.pressure(rho, 0.0), p, 0.005 * p);
  EXPECT_NEAR(p / (1630.0 * 6930.0) + tnt_isentrope.sound_speed(rho, p), 6930.0, 0.02 * 6930.0);
}

// On an isentrope of the full law the energy above its cold curve falls like rho^om.
TEST(Jwlc, IsAnIsentropeOfTheFullLaw) {
  for (double rho = 1.0; rho < 3e3; rho *= 1.5) {
    const double E = rho * tnt_isentrope.cold_energy(rho);
    EXPECT_NEAR(tnt.pressure(rho, E), tnt_isentrope.pressure(rho, E),
                1e-12 * tnt_isentrope.pressure(rho, E));
    EXPECT_NEAR(tnt.sound_speed_squared(rho, E), tnt_isentrope.sound_speed_squared(rho, E),
                1e-12 * tnt_isentrope.sound_speed_squared(rho, E));
  }
}

}  // namespace
}  // namespace sluice::eos::jwlc_test
