// DDT1: where it burns and detonates, cracks, and flames that need time, against closed forms.
#include "models/burn/ddt1.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "models/test_support/hmx.hpp"

namespace sluice::models::ddt1_test {
namespace {

Ddt1 explosive() {
  Ddt1 law;
  law.flame = hmx();
  law.flame.threshold_pressure = 5e4;
  law.flame.ignition_temperature = 550;
  law.detonation.threshold_pressure = 5.3e9;
  law.cracks = true;
  return law;
}

TEST(Ddt1, BurnsBelowThePressureAtWhichItDetonates) {
  const Ddt1 law = explosive();
  EXPECT_FALSE(law.deflagrates(4.9e4));
  EXPECT_TRUE(law.deflagrates(5e4));
  EXPECT_TRUE(law.deflagrates(5.3e9));
  EXPECT_FALSE(law.detonates(5.3e9));
  EXPECT_TRUE(law.detonates(5.31e9));
  EXPECT_FALSE(law.deflagrates(5.31e9));
}

// The published criterion: a = sqrt(8e8/p^2.84), SI units.
TEST(Ddt1, FlamesEnterCracksByTheirRadius) {
  Ddt1 law = explosive();
  for (const double p : {1e5, 1e6, 1e7, 1e9}) {
    const double a = std::sqrt(8e8 / std::pow(p, 2.84));
    EXPECT_TRUE(law.cracked(1.001 * a, p));
    EXPECT_FALSE(law.cracked(0.999 * a, p));
  }
  EXPECT_FALSE(law.cracked(1, 0));
  EXPECT_FALSE(law.cracked(1, -1e9));
  law.cracks = false;
  EXPECT_FALSE(law.cracked(1, 1e9));
}

// Walls of an area that stays recede through the explosive between them: m = m_0 (1 - t/t_end),
// t_end = rho L/flux, in steps of any length.
TEST(Ddt1, CracksBurnAtTheFluxOfTheirWalls) {
  const Ddt1 law = explosive();
  const double flux = 20, density = 1832, end = density * law.crack_spacing / flux;
  for (const int steps : {4, 100}) {
    double filled = 1;
    for (int n = 0; n < steps / 2; ++n)
      filled *= 1 - law.burned_in_cracks(end / steps, flux, density, filled);
    EXPECT_NEAR(filled, 0.5, 1e-12) << steps;
  }
}

FlameSpread spread() {
  return {0.2, 0.00259, 1e5, 0.538};
}

// As the format writes it: A = (1 + I)/2 + (1 - I)/2 sin(2 theta - pi/2).
TEST(FlameSpread, IsSlowerAlongTheSurface) {
  const FlameSpread flames = spread();
  const double pi = std::numbers::pi;
  for (double theta = 0; theta < pi; theta += 0.1)
    EXPECT_NEAR(flames.share(std::cos(theta)), 0.6 + 0.4 * std::sin(2 * theta - pi / 2), 1e-15);
  EXPECT_DOUBLE_EQ(flames.share(1), 0.2);
  EXPECT_DOUBLE_EQ(flames.share(-1), 0.2);
  EXPECT_DOUBLE_EQ(flames.share(0), 1);
}

TEST(FlameSpread, ComesAfterItsDelayInStepsOfAnyLength) {
  const FlameSpread flames = spread();
  const double p = 3e6, way = 0.001;
  const double tau = 0.001 / (0.00259 * std::pow(30, 0.538));
  EXPECT_NEAR(flames.delay(way, p) / tau, 1, 1e-14);
  for (const int steps : {1, 3, 1000}) {
    Ignition flame{Ignition::surface, 0, 0, way};
    for (int n = 0; n < steps; ++n) {
      EXPECT_FALSE(flame.burns());
      flame = flames.after(tau * (1 + 1e-9) / steps, flame, p);
    }
    EXPECT_TRUE(flame.burns()) << steps;
    EXPECT_NEAR(flame.time / tau, 1, 1e-8);
  }
}

// A half of the way at one pressure, a half at another: half of each delay.
TEST(FlameSpread, FollowsThePressure) {
  const FlameSpread flames = spread();
  const double before = flames.delay(0.001, 1e6), after = flames.delay(0.001, 4e6);
  EXPECT_NEAR(before / after, std::pow(4, 0.538), 1e-12);
  Ignition flame{Ignition::cracks, 0, 0, 0.001};
  for (int n = 0; n < 100; ++n) flame = flames.after(before / 200, flame, 1e6);
  EXPECT_NEAR(flame.come, 0.5, 1e-12);
  for (int n = 0; n < 99; ++n) flame = flames.after(after / 200, flame, 4e6);
  EXPECT_NEAR(flame.come, 0.995, 1e-12);
  EXPECT_FALSE(flame.burns());
}

TEST(FlameSpread, IsThereAtOnceWithoutAWay) {
  const Ignition flame = spread().after(1e-9, {Ignition::cracks, 0, 0, 0}, 1e6);
  EXPECT_TRUE(flame.burns());
  EXPECT_FALSE(Ignition{}.lit());
}

}  // namespace
}  // namespace sluice::models::ddt1_test
