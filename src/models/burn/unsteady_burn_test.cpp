// Unsteady burning: its steady state, its delays, and its response to a pressure that oscillates,
// against the linear theory of its equations.
#include "models/burn/unsteady_burn.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "models/test_support/hmx.hpp"

namespace sluice::models::unsteady_burn_test {
namespace {

using Complex = std::complex<double>;

constexpr double p0 = 3.445e6, T0 = 300, density = hmx_density;

UnsteadyBurn propellant() {
  UnsteadyBurn law{hmx()};
  law.solid_delay = 0.2;
  law.gas_delay = 0.25;
  return law;
}
double delay_of(const UnsteadyBurn& law, double m) {
  return law.solid_delay * law.conductivity * density / (law.specific_heat * m * m);
}

// A step at this pressure: the rate.
double step(const UnsteadyBurn& law, double dt, double p, SurfaceHistory& surface) {
  const BurningSurface steady = law.surface(p, T0, density);
  surface = law.after(dt, surface, steady, T0, density);
  return law.flux(surface, steady.flux, density);
}

TEST(UnsteadyBurn, BeginsAtTheSteadyRate) {
  const UnsteadyBurn law = propellant();
  for (const double p : {5e4, 1e6, p0, 5e7, 1e9}) {
    SurfaceHistory surface;
    EXPECT_FALSE(surface.lit());
    EXPECT_NEAR(step(law, 1e-6, p, surface) / law.surface(p, T0, density).flux, 1, 1e-9) << p;
    EXPECT_TRUE(surface.lit());
  }
}

TEST(UnsteadyBurn, SettlesToTheSteadyRate) {
  const UnsteadyBurn law = propellant();
  SurfaceHistory surface;
  step(law, 1e-6, 0.8 * p0, surface);
  const double m = law.surface(p0, T0, density).flux, tau = delay_of(law, m);
  double rate = 0, most = 0;
  for (int n = 0; n < 300; ++n) {
    rate = step(law, 0.1 * tau, p0, surface);
    most = std::max(most, rate / m);
  }
  EXPECT_GT(most, 1.05);  // the surface is hot before the solid is
  EXPECT_NEAR(rate / m, 1, 1e-9);
}

// At constant pressure differences fall as exponentials, whatever the steps.
TEST(UnsteadyBurn, RemembersForItsDelays) {
  const UnsteadyBurn law = propellant();
  const BurningSurface steady = law.surface(p0, T0, density);
  const double tau = delay_of(law, steady.flux);
  const double gradient =
      (steady.temperature - T0) * steady.flux * law.specific_heat / law.conductivity;
  for (const int steps : {1, 7, 100}) {
    SurfaceHistory surface{steady.temperature - 10, 0.9 * gradient};
    for (int n = 0; n < steps; ++n) surface = law.after(tau / steps, surface, steady, T0, density);
    EXPECT_NEAR((1 - surface.gradient / gradient) / (0.1 * std::exp(-1.0)), 1, 1e-9) << steps;
    EXPECT_NEAR((steady.temperature - surface.temperature) / (10 * std::exp(-4.0)), 1, 1e-9);
  }
}

TEST(UnsteadyBurn, CountsAPowerOfTheRatioOfRates) {
  UnsteadyBurn law = propellant();
  const double m = law.surface(p0, T0, density).flux;
  SurfaceHistory surface;
  step(law, 1e-6, 0.9 * p0, surface);
  const double ratio = law.flux(surface, m, density) / m;
  law.rate_power = 0.5;
  EXPECT_NEAR(law.flux(surface, m, density) / m, std::sqrt(ratio), 1e-12);
  law.rate_power = 0;
  EXPECT_DOUBLE_EQ(law.flux(surface, m, density), m);
}

// After a sudden rise of pressure T_s outruns beta until the roots meet: the rate goes on from
// there and comes back, without a jump.
TEST(UnsteadyBurn, GoesOnWhereTheRootsMeet) {
  const UnsteadyBurn law = propellant();
  SurfaceHistory surface;
  const double p = 1.5 * p0, m = law.surface(p, T0, density).flux, tau = delay_of(law, m);
  double rate = step(law, 1e-6, p0, surface), most_jump = 0;
  int met = 0;
  for (int n = 0; n < 20000; ++n) {
    const double before = rate;
    rate = step(law, 1e-3 * tau, p, surface);
    most_jump = std::max(most_jump, std::fabs(rate - before) / m);
    const double highest = law.conductivity * surface.gradient / law.solid_heat;
    EXPECT_LE(rate, highest * (1 + 1e-12));
    if (rate > highest * (1 - 1e-12)) ++met;
  }
  EXPECT_GT(met, 100);
  EXPECT_LT(most_jump, 0.1);  // 0.039: the roots meet as a square root does
  EXPECT_NEAR(rate / m, 1, 1e-6);
}

// Without heat in the solid the reaction takes what is conducted: no root to choose.
TEST(UnsteadyBurn, NeedsNoHeatInTheSolid) {
  UnsteadyBurn law = propellant();
  law.solid_heat = 0;
  SurfaceHistory surface;
  EXPECT_NEAR(step(law, 1e-6, p0, surface) / law.surface(p0, T0, density).flux, 1, 1e-9);
}

// Relative change of the rate over that of the pressure, at w times the delay of the gradient.
// Small changes x' e^{iwt} of the steady equations and of the model's, with E = E_c/(R T_s):
//   2 m'/m = T' (2/T + E/T - 1/(T - C2)),  T = C4 + C5/s^2,  s = sqrt(m^2 + C3) + m
//   C3', C5' = 2 (p'/p) C3, C5
//   beta' (1 + iw) = beta'_s,  T' (1 + iw N_g) = T'_s
//   (Q_c m - K_c beta) m' = K_c m beta' - X (2 + E) T'/T
Complex linear_response(const UnsteadyBurn& k, double w) {
  const double R = k.gas_constant, cp = k.specific_heat;
  const auto [T, m] = k.surface(p0, T0, density);
  const double C2 = T0 + k.solid_heat / (2 * cp);
  const double C3 =
      4 * k.gas_conductivity * k.gas_rate * k.molar_mass * k.molar_mass * p0 * p0 / (cp * R * R);
  const double C5 = k.gas_heat / cp * C3, root = std::sqrt(m * m + C3), s = root + m;
  const double E = k.activation / (R * T);
  const double of_m = 0.5 * m * ((2 + E) / T - 1 / (T - C2));  // dm_s/dT_s
  // T'_s = 2 C5/s^2 - (2 C5/s^3) ((m m' + C3)/root + m'), of p'/p = 1.
  const double a = 2 * C5 / (s * s), b = a / s;
  const double Ts = (a - b * C3 / root) / (1 + b * (m / root + 1) * of_m), ms = of_m * Ts;
  const double beta = m * cp * (T - T0) / k.conductivity;
  const double beta_s = cp / k.conductivity * (ms * (T - T0) + m * Ts);
  const double X =
      k.solid_rate * R * k.conductivity * density * T * T * std::exp(-E) / k.activation;
  const Complex beta_w = beta_s / Complex(1, w), T_w = Ts / Complex(1, w * k.gas_delay);
  const Complex m_w = (k.conductivity * m * beta_w - X * (2 + E) * T_w / T) /
                      (k.solid_heat * m - k.conductivity * beta);
  return (k.rate_power * m_w + (1 - k.rate_power) * ms) / m;
}

// The law itself, in steps: the first harmonic of a whole period, once it has settled.
Complex measured_response(const UnsteadyBurn& law, double w, int steps) {
  constexpr double amplitude = 1e-4;
  const double m = law.surface(p0, T0, density).flux;
  const double dt = 2 * std::numbers::pi / w * delay_of(law, m) / steps;
  const int settling = static_cast<int>(std::ceil(20 / (2 * std::numbers::pi / w))) * steps;
  SurfaceHistory surface;
  step(law, dt, p0, surface);
  Complex sum = 0;
  for (int n = 1; n <= settling + steps; ++n) {
    const double phase = 2 * std::numbers::pi * n / steps;
    const double rate = step(law, dt, p0 * (1 + amplitude * std::sin(phase)), surface);
    if (n > settling) sum += rate / m * std::polar(1.0, -phase);
  }
  return sum * Complex(0, 2) / (amplitude * steps);
}

double error_of_response(const UnsteadyBurn& law, double w, int steps) {
  const Complex expected = linear_response(law, w);
  return std::abs(measured_response(law, w, steps) - expected) / std::abs(expected);
}

// Measured with 200 steps a period: 1.6 % at most, half a step of phase.
TEST(UnsteadyBurn, RespondsToOscillatingPressureAsLinearTheoryHasIt) {
  UnsteadyBurn law = propellant();
  for (const double w : {0.1, 0.3, 1., 3., 10., 30.})
    EXPECT_LT(error_of_response(law, w, 200), 0.02) << w;
  law.rate_power = 0.6;
  for (const double w : {0.3, 3., 30.}) EXPECT_LT(error_of_response(law, w, 200), 0.02) << w;
}

// Measured: 0.031, 0.0155, 0.0077.
TEST(UnsteadyBurn, RespondsAtFirstOrderInTheStep) {
  const UnsteadyBurn law = propellant();
  const double coarse = error_of_response(law, 2, 100), middle = error_of_response(law, 2, 200),
               fine = error_of_response(law, 2, 400);
  EXPECT_NEAR(coarse / middle, 2, 0.1);
  EXPECT_NEAR(middle / fine, 2, 0.1);
}

// Where pressure changes slowly it is the exponent of the steady rate.
TEST(UnsteadyBurn, FollowsSlowChangesAsTheSteadyRate) {
  const UnsteadyBurn law = propellant();
  const double h = 1e-4, exponent = std::log(law.surface(p0 * (1 + h), T0, density).flux /
                                             law.surface(p0 * (1 - h), T0, density).flux) /
                                    std::log((1 + h) / (1 - h));
  EXPECT_NEAR(linear_response(law, 0).real(), exponent, 1e-6);
}

}  // namespace
}  // namespace sluice::models::unsteady_burn_test
