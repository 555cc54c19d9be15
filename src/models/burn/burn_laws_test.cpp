// Laws of burning against closed forms and against the equations in the form of the literature.
#include <gtest/gtest.h>

#include <cmath>

#include "models/burn/jwlpp.hpp"
#include "models/burn/simple_burn.hpp"
#include "models/burn/steady_burn.hpp"
#include "models/test_support/hmx.hpp"

namespace sluice::models::burn_laws_test {
namespace {

TEST(SimpleBurn, FollowsThePressure) {
  SimpleBurn law;
  law.coefficient = 75.3;
  law.reference_pressure = 101325;
  law.threshold_pressure = 5e4;
  law.threshold_temperature = 450;
  EXPECT_DOUBLE_EQ(law.flux(101325), 75.3);
  EXPECT_NEAR(law.flux(10 * 101325) / 75.3, std::pow(10, 0.778), 1e-12);
  EXPECT_TRUE(law.burns(5.1e4, 451));
  EXPECT_FALSE(law.burns(4.9e4, 451));
  EXPECT_FALSE(law.burns(5.1e4, 449));
}

JwlPp anfo() {
  JwlPp law;
  law.G = 3.5083e-7;
  law.b = 1.3;
  law.rho0 = 1160;
  law.threshold_pressure = 2e8;
  return law;
}

// dF/dt = G (1 - F) p^b at constant pressure: 1 - F falls as an exponential, whatever the steps.
TEST(JwlPp, BurnsAsTheExponentialWhateverTheSteps) {
  const JwlPp law = anfo();
  const double p = 5e9, time = 1e-6, rate = law.G * std::pow(p, law.b);
  for (const int steps : {7, 100}) {
    double reactant = 1160, product = 0;
    for (int n = 0; n < steps; ++n) {
      const double burned = law.burned(time / steps, p, reactant, product);
      reactant -= burned;
      product += burned;
    }
    EXPECT_NEAR(reactant / 1160 / std::exp(-rate * time), 1, 1e-12) << steps;
  }
}

TEST(JwlPp, BurnsNoMoreThanItMayInAStep) {
  const JwlPp law = anfo();
  EXPECT_DOUBLE_EQ(law.burned(1, 5e9, 1160, 0), 0.2 * 1160);
  EXPECT_DOUBLE_EQ(law.burned(1, 5e9, 100, 500), 100);
  EXPECT_EQ(law.burned(1, 5e9, 5, 995), 0);  // F = 0.995
  EXPECT_TRUE(law.burns(3e8, 0.5));
  EXPECT_FALSE(law.burns(1e8, 0.5));
  EXPECT_FALSE(law.burns(3e8, 0.005));
}

constexpr double density = hmx_density;

// The flame stands x_g before the surface: x_g = 2 x_cd/(sqrt(1 + Da) - 1), x_cd = K_g/(m c_p),
// Da = 4 B_g W^2 c_p p^2 x_cd^2/(R^2 K_g); T_s = T_0 + Q_c/c_p + Q_g/(c_p (1 + x_g/x_cd)).
double temperature_by_the_flame(const SteadyBurn& k, double m, double p, double T0) {
  const double R = k.gas_constant, x_cd = k.gas_conductivity / (m * k.specific_heat);
  const double Da = 4 * k.gas_rate * k.molar_mass * k.molar_mass * k.specific_heat * p * p * x_cd *
                    x_cd / (R * R * k.gas_conductivity);
  const double x_g = 2 * x_cd / (std::sqrt(1 + Da) - 1);
  return T0 + k.solid_heat / k.specific_heat + k.gas_heat / (k.specific_heat * (1 + x_g / x_cd));
}
double flux_of_the_solid(const SteadyBurn& k, double Ts, double T0) {
  const double R = k.gas_constant;
  return std::sqrt(
      k.conductivity * density * k.solid_rate * R * Ts * Ts * std::exp(-k.activation / (R * Ts)) /
      (k.specific_heat * k.activation * (Ts - T0 - k.solid_heat / (2 * k.specific_heat))));
}

TEST(SteadyBurn, SolvesTheEquationsOfSurfaceAndFlame) {
  const SteadyBurn law = hmx();
  for (const double p : {5e4, 1e5, 1e6, 7e6, 5e7, 1e9})
    for (const double T0 : {250., 298., 420.}) {
      const BurningSurface s = law.surface(p, T0, density);
      EXPECT_NEAR(s.flux / flux_of_the_solid(law, s.temperature, T0), 1, 1e-9) << p;
      EXPECT_NEAR(s.temperature / temperature_by_the_flame(law, s.flux, p, T0), 1, 1e-9) << p;
    }
}

// With the constants of HMX some tenths of a mm/s at 1 atm, about 1 cm/s at 7 MPa (0.34 and 11.3
// mm/s); the rate grows with pressure and with the temperature of the solid.
TEST(SteadyBurn, BurnsHmxAtItsRates) {
  const SteadyBurn law = hmx();
  EXPECT_NEAR(1e3 * law.surface(101325, 298, density).flux / density, 0.45, 0.15);
  EXPECT_NEAR(1e3 * law.surface(7e6, 298, density).flux / density, 14, 3);
  double before = 0;
  for (double p = 1e4; p < 1e9; p *= 3) {
    const double flux = law.surface(p, 298, density).flux;
    EXPECT_GT(flux, before);
    EXPECT_GT(law.surface(p, 400, density).flux, flux);
    before = flux;
  }
}

}  // namespace
}  // namespace sluice::models::burn_laws_test
