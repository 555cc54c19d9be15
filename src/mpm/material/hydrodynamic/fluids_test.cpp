// Closed forms of water, TH_water, ideal_gas, jwlpp_mpm and program_burn.
#include <cmath>

#include "eos/thomsen_hartka_water.hpp"
#include "mpm/material/test_support/law_test_support.hpp"

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
  // Of a shock in one step: what the pressure and the viscosity work is heat, c_v dT per mass.
  EXPECT_NEAR(q.energy() / (1.2 * 717.5 * (q.temperature() - 300)), 1, 1e-2);
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

const std::string programmed =
    "<K>1.9342e-10</K><n>15.2</n><A>7.73037e11</A><B>21.629e9</B><C>1.339e9</C><R1>4.5</R1>"
    "<R2>1.5</R2><om>.33</om><D>8e3</D><T0>1e-3</T0>";

// A particle of 1 m^3 burns over 1.5 m of the way of the detonation, which comes at T0 + s/D.
TEST(ProgramBurn, BurnsWhenTheDetonationArrives) {
  const auto made =
      law("program_burn", programmed + "<starting_location>[1,0,0]</starting_location>");
  MaterialSample s(made, steel_constants(), 1, 298, {4, 4, 12});
  const double t_b = 1e-3 + 13 / 8e3, width = 1.5 / 8e3;
  EXPECT_DOUBLE_EQ(s.history(1), t_b);
  const auto still = [](double) { return identity; };
  follow(s, still, t_b, 10);
  EXPECT_NEAR(s.history(0), 0, 1e-12);
  EXPECT_NEAR(s.pressure(), 0, 1);
  follow(s, still, t_b + 0.5 * width, 7);
  EXPECT_NEAR(s.history(0), 0.5, 1e-12);
  EXPECT_NEAR(s.pressure() / (0.5 * jwl(1)), 1, 1e-10);
  follow(s, still, t_b + 0.97 * width, 7);
  EXPECT_EQ(s.history(0), 1);
  EXPECT_EQ(s.energy(), 0);  // no work: the heat was in the explosive
  // Products expand along their isentrope: the work is its integral.
  follow(
      s, [&](double t) { return Matrix{1 + (t - s.time()), 0, 0, 0, 1, 0, 0, 0, 1}; }, s.time() + 1,
      2000);
  const auto stored = [](double J) {
    return 7.73037e11 / 4.5 * std::exp(-4.5 * J) + 21.629e9 / 1.5 * std::exp(-1.5 * J) +
           1.339e9 / 0.33 * std::pow(J, -0.33);
  };
  EXPECT_NEAR(s.energy() / (stored(s.volume_ratio()) - stored(1)), 1, 1e-5);
  EXPECT_NEAR(s.pressure() / jwl(s.volume_ratio()), 1, 1e-12);
}

TEST(ProgramBurn, StartsFromAPlane) {
  const auto made = law("program_burn", programmed +
                                            "<starting_location>[1,0,0]</starting_location>"
                                            "<direction_if_plane>[0,3,4]</direction_if_plane>");
  const MaterialSample s(made, steel_constants(), 1, 298, {7, 5, -10});
  EXPECT_DOUBLE_EQ(s.history(1), 1e-3 + 5 / 8e3);  // |3 - 8|
}

// rho0 below the density: the solid starts under pressure.
TEST(ProgramBurn, DensityOfReference) {
  const MaterialSample s(
      law("program_burn", programmed + "<rho0>7800</rho0>"
                                       "<starting_location>[1,0,0]</starting_location>"),
      steel_constants(), 1, 298);
  EXPECT_NEAR(s.pressure() / ((std::pow(7830.0 / 7800, 15.2) - 1) / (15.2 * 1.9342e-10)), 1, 1e-9);
}

// Slow compression stays on the isentrope of the equation of state, the state after it has the
// energy that it was given; where water is densest, pressing does not warm it.
TEST(ThermalWater, CompressesAlongItsIsentrope) {
  const eos::ThomsenHartkaWater water;
  for (const double T : {300.0, 277.0}) {
    MaterialConstants c = steel_constants();
    c.density = water.density(101325, T);
    MaterialSample s(law("TH_water", "", c), c, 1, T);
    EXPECT_NEAR(s.pressure(), 0, 1e-3);
    EXPECT_NEAR(s.wave_speed(), water.sound_speed(c.density, 101325), 1e-3);
    follow(
        s, [](double t) { return Matrix{1 - 0.01 * t, 0, 0, 0, 1, 0, 0, 0, 1}; }, 1, 200);
    const double rho = c.density / 0.99, p = s.pressure() + 101325;
    EXPECT_NEAR(water.density(p, s.temperature()) / rho, 1, 1e-9);
    const double e_0 = water.energy_from_temperature(c.density, T) / c.density;
    const double e = water.energy_from_temperature(rho, s.temperature()) / rho;
    // sigma is without Pref, whose work the water received too.
    EXPECT_NEAR((e - e_0) / (s.energy() / c.density + 101325 * (1 / c.density - 1 / rho)), 1, 1e-5);
    // dT/dp = T v beta/c_p: of the mean beta = 2 L x/(v/v0) on the way
    const double x = 0.5 * (s.temperature() + T) - 277 + 2e-7 * 0.5 * p;
    const double cp = water.co - water.b * (T - 277) - T * water.vo * water.L * p;
    const double expected = T * water.vo * 2 * water.L * x / cp * (p - 101325);
    EXPECT_NEAR((s.temperature() - T) / expected, 1, 0.02) << T;
  }
}

TEST(ThermalWater, EndsWhereItsLawEnds) {
  MaterialConstants c = steel_constants();
  c.density = eos::ThomsenHartkaWater{}.density(101325, 300);
  MaterialSample s(law("TH_water", "", c), c, 1, 300);
  const auto fault = s.step({0.5, 0, 0, 0, 1, 0, 0, 0, 1}, 1e-3);
  ASSERT_TRUE(fault);
  EXPECT_STREQ(fault->reason, "water beyond the law of Thomsen and Hartka, density");
}

}  // namespace
}  // namespace sluice::mpm::fluids
