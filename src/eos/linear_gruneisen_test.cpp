// Linear Gruneisen: every check of a law, and its reference state.
#include "eos/linear_gruneisen.hpp"

#include "eos/eos_test_support.hpp"

namespace sluice::eos::linear_gruneisen_test {
namespace {

TEST(LinearGruneisen, IsConsistent) {
  check_law(propellant, {1000.0, 4e3, 100.0, 3e3});
  check_extremes(propellant, 1823.3, 1e6);
}

TEST(LinearGruneisen, PassesThroughItsReferenceState) {
  const double E = propellant.energy_from_temperature(1823.3, 317.4);
  EXPECT_NEAR(propellant.pressure(1823.3, E), 101325.0, 1e-4);
  EXPECT_NEAR(propellant.density(101325.0, 317.4), 1823.3, 1e-9);
  const double c2 = 1.3338e9 / 1823.3 + 317.4 * std::pow(7.027e5 / 1823.3, 2) / 1000.0;
  EXPECT_NEAR(propellant.sound_speed_squared(1823.3, E), c2, 1e-9 * c2);
}

}  // namespace
}  // namespace sluice::eos::linear_gruneisen_test
