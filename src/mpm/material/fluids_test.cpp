// Closed forms of water, ideal_gas and jwlpp_mpm.
#include <cmath>

#include "mpm/material/law_test_support.hpp"

namespace sluice::mpm::fluids {
namespace {

TEST(Water, PressureAndViscosity) {
  MaterialSample s(law("water",
                       "<bulk_modulus>15000</bulk_modulus><viscosity>.5</viscosity>"
                       "<gamma>7</gamma>"),
                   steel_constants(), 1, 298);
  const double rate = 3;  // steady simple shear: sigma_12 = mu du/dy
  follow(
      s, [&](double t) { return Matrix{1, rate * t, 0, 0, 1, 0, 0, 0, 1}; }, 1, 100);
  EXPECT_NEAR(s.stress()[5], 0.5 * rate, 1e-10);
  EXPECT_NEAR(s.energy(), 0.5 * rate * rate, 1e-9);  // all of it heat
  MaterialSample pressed(law("water",
                             "<bulk_modulus>15000</bulk_modulus><viscosity>0</viscosity>"
                             "<gamma>7</gamma>"),
                         steel_constants(), 1, 298);
  ASSERT_EQ(pressed.step({0.9, 0, 0, 0, 1, 0, 0, 0, 1}, 1), std::nullopt);
  EXPECT_NEAR(pressed.pressure(), 15000 * (std::pow(0.9, -7.0) - 1), 1e-8);
}

TEST(IdealGas, CompressesAlongItsIsentrope) {
  MaterialConstants air = steel_constants();
  air.density = 1.2;
  const std::string tags =
      "<specific_heat>717.5</specific_heat><gamma>1.4</gamma><Pref>0</Pref>"
      "<UseArtificialViscosity>";
  MaterialSample s(law("ideal_gas", tags + "false</UseArtificialViscosity>", air), air, 1, 300);
  const double p_0 = 0.4 * 1.2 * 717.5 * 300;
  EXPECT_NEAR(s.pressure(), p_0, 1e-8);
  follow(
      s, [](double t) { return Matrix{1 - 0.5 * t, 0, 0, 0, 1, 0, 0, 0, 1}; }, 1, 200);
  EXPECT_NEAR(s.pressure() / (p_0 * std::pow(2, 1.4)), 1, 1e-12);
  EXPECT_NEAR(s.temperature() / (300 * std::pow(2, 0.4)), 1, 1e-12);
  // Work = heat: c_v dT per mass.
  EXPECT_NEAR(s.energy() / (1.2 * 717.5 * (s.temperature() - 300)), 1, 1e-5);  // trapezoidal
  EXPECT_NEAR(s.wave_speed(), std::sqrt(1.4 * 0.4 * 717.5 * s.temperature()), 1e-8);
  MaterialSample q(law("ideal_gas", tags + "true</UseArtificialViscosity>", air), air, 1, 300);
  ASSERT_EQ(q.step({0.99, 0, 0, 0, 1, 0, 0, 0, 1}, 0.001), std::nullopt);
  EXPECT_GT(q.pressure(), p_0 * std::pow(0.99, -1.4) * 1.001);
}

const std::string explosive =
    "<murnaghan_K>1.9342e-10</murnaghan_K><murnaghan_n>15.2</murnaghan_n><jwl_A>7.73037e11</jwl_A>"
    "<jwl_B>21.629e9</jwl_B><jwl_C>1.339e9</jwl_C><jwl_R1>4.5</jwl_R1><jwl_R2>1.5</jwl_R2>"
    "<jwl_om>.33</jwl_om><reaction_G>1</reaction_G><reaction_b>1.05</reaction_b>"
    "<ignition_pressure>2e8</ignition_pressure>";

double jwl(double J) {
  return 7.73037e11 * std::exp(-4.5 * J) + 21.629e9 * std::exp(-1.5 * J) +
         1.339e9 * std::pow(J, -1.33);
}

TEST(Jwlpp, StartsUnderItsPressureAndBurnsToJwl) {
  const auto made = law("jwlpp_mpm", explosive +
                                         "<useInitialStress>true</useInitialStress>"
                                         "<initial_pressure>2.1e8</initial_pressure>");
  MaterialSample s(made, steel_constants(), 1, 298);
  EXPECT_NEAR(s.pressure(), 2.1e8, 1);
  const double J = std::pow(1 + 15.2 * 1.9342e-10 * 2.1e8, -1 / 15.2);
  follow(
      s, [](double) { return identity; }, 1e-6, 1000);
  EXPECT_EQ(s.history(0), 1);
  EXPECT_NEAR(s.pressure() / jwl(J), 1, 1e-12);
}

// df/dt = G (1 - f) p^b against a fine integration by Euler's method.
TEST(Jwlpp, BurnsAtItsRate) {
  const auto made = law("jwlpp_mpm", explosive +
                                         "<useInitialStress>true</useInitialStress>"
                                         "<initial_pressure>2.1e8</initial_pressure>");
  MaterialSample s(made, steel_constants(), 1, 298);
  const double end = 4e-11;
  follow(
      s, [](double) { return identity; }, end, 4);
  const double J = std::pow(1 + 15.2 * 1.9342e-10 * 2.1e8, -1 / 15.2);
  double f = 0;
  const int n = 200000;
  for (int k = 0; k < n; ++k) {
    const double p = (1 - f) * 2.1e8 + f * jwl(J);
    f += end / n * (1 - f) * std::pow(p, 1.05);
  }
  EXPECT_GT(f, 0.05);
  EXPECT_NEAR(s.history(0) / f, 1, 1e-3);
}

TEST(Jwlpp, DoesNotBurnBelowItsIgnitionPressure) {
  MaterialSample s(law("jwlpp_mpm", explosive), steel_constants(), 1, 298);
  ASSERT_EQ(s.step({0.99, 0, 0, 0, 1, 0, 0, 0, 1}, 1), std::nullopt);
  ASSERT_EQ(s.step({0.985, 0, 0, 0, 1, 0, 0, 0, 1}, 1), std::nullopt);
  EXPECT_EQ(s.history(0), 0);
  EXPECT_NEAR(s.pressure(), (std::pow(0.985, -15.2) - 1) / (15.2 * 1.9342e-10), 1);
}

}  // namespace
}  // namespace sluice::mpm::fluids
