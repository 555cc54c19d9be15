// Knauss sea water: every check of a law, and the sea.
#include "eos/knauss_sea_water.hpp"

#include "eos/eos_test_support.hpp"

namespace sluice::eos::knauss_sea_water_test {
namespace {

TEST(KnaussSeaWater, IsConsistent) {
  const KnaussSeaWater sea{{}};
  check_law(sea, {900.0, 2e3, 250.0, 400.0});
  check_extremes(sea, 1027.0, 1.2e6);
  const KnaussSeaWater rising{{.a = 0.18,
                               .b = 0.78,
                               .K = 4.6512e-7,
                               .T0 = 300.0,
                               .S = 0.0,
                               .S0 = 0.0,
                               .rho0 = 999.8,
                               .specific_heat = 4186.0}};
  check_law(rising, {900.0, 2e3, 250.0, 400.0});
}

TEST(KnaussSeaWater, IsTheSea) {  // sound in sea water of 10 C and 35 per mille: 1490 m/s
  const KnaussSeaWater sea{{.b = 0.78, .S = 30.0}};
  EXPECT_NEAR(sea.density(101325.0, 283.15), 1027.0 - 5 * 0.78, 1e-9);
  EXPECT_NEAR(sea.sound_speed(1027.0, 101325.0), 1490.0, 10.0);
  EXPECT_NEAR(sea.density(1e7, 283.15) - sea.density(101325.0, 283.15), 4.45, 0.01);
}

}  // namespace
}  // namespace sluice::eos::knauss_sea_water_test
