// Closed forms and paths of p_alpha, mw_visco_elastic and hypoViscoElastic metals.
#include <gmock/gmock.h>

#include <cmath>
#include <random>

#include "mpm/material/test_support/law_test_support.hpp"

namespace sluice::mpm::porous_and_relaxing {
namespace {

MaterialConstants porous_constants() {
  MaterialConstants c = steel_constants();
  c.density = 14100;
  c.specific_heat = 150;
  return c;
}
constexpr double Ps = 6e9, Pe = 0.46e9, rhoS = 16281, K0 = 35.2e9, C0 = 2000, Gamma = 1.2, S = 1.1;
constexpr double alpha_0 = rhoS / 14100, solid_K = rhoS * C0 * C0;
const std::string porous =
    "<Ps>6e9</Ps><Pe>.46e9</Pe><rhoS>16281</rhoS><K0>35.2e9</K0><T_0>298</T_0><C_0>2000</C_0>"
    "<Gamma_0>1.2</Gamma_0><S_alpha>1.1</S_alpha>";

MaterialSample porous_sample(double temperature = 298) {
  return {law("p_alpha", porous, porous_constants()), porous_constants(), 1, temperature};
}
Matrix pressed(double J) {
  return {J, 0, 0, 0, 1, 0, 0, 0, 1};
}
double hugoniot(double J_s) {
  const double eta = 1 - J_s;
  return solid_K * eta / std::pow(1 - S * eta, 2);
}

// One step to a volume: the Hugoniot of the crushed body follows from that of the solid at the
// same volume (Zel'dovich and Raizer 1967),
//   p (1 - Gamma (alpha0 - J_s)/2) = p_H (1 - Gamma (1 - J_s)/2).
TEST(PorousSolid, ShockLandsOnTheHugoniotOfThePorousBody) {
  MaterialSample s = porous_sample();
  const double J = 0.75, J_s = J * alpha_0;
  ASSERT_EQ(s.step(pressed(J), 1e-6), std::nullopt);
  const double expected =
      hugoniot(J_s) * (1 - Gamma * (1 - J_s) / 2) / (1 - Gamma * (alpha_0 - J_s) / 2);
  EXPECT_GT(expected, Ps);
  EXPECT_NEAR(s.pressure() / expected, 1, 1e-12);
  EXPECT_EQ(s.history(0), 1);
  EXPECT_NEAR(s.energy() / (0.5 * expected * (1 - J)), 1, 1e-12);
}

// Below Pe nothing stays: stress, distension, energy and temperature come back.
TEST(PorousSolid, IsElasticBelowItsCrushPressure) {
  MaterialSample s = porous_sample();
  const double J = 0.989;
  const auto path = [&](double t) { return pressed(1 - (1 - J) * (1 - std::abs(1 - t))); };
  double highest = 0, least = 2;
  follow(s, path, 2, 400, [&](const MaterialSample& now) {
    highest = std::max(highest, now.pressure());
    least = std::min(least, now.history(0));
  });
  EXPECT_GT(highest, 0.8 * Pe);
  EXPECT_LT(highest, Pe);
  EXPECT_LT(least, alpha_0 - 3e-3);
  EXPECT_NEAR(s.pressure(), 0, 1e-7 * K0);
  EXPECT_NEAR(s.history(0), alpha_0, 1e-12);
  EXPECT_EQ(s.history(1), alpha_0);
  EXPECT_NEAR(s.energy(), 0, 1e-7 * Pe);
  EXPECT_NEAR(s.temperature(), 298, 1e-4);
}

// Slow crushing: on the curve of (Ps - p)^2, with the pressure of the solid at its own volume and
// energy; what is taken out again is less than what went in, and the volume stays less.
TEST(PorousSolid, CrushesAlongItsCurve) {
  MaterialSample s = porous_sample();
  const double closing = alpha_0 * (1 / K0 - alpha_0 / solid_K) / (alpha_0 - 1);
  const double elastic = (alpha_0 - 1) * std::exp(-closing * Pe);
  follow(
      s, [](double t) { return pressed(1 - 0.1 * t); }, 1, 400);
  const double p = s.pressure(), alpha = s.history(0), J_s = 0.9 * alpha_0 / alpha;
  EXPECT_GT(p, Pe);
  EXPECT_LT(p, Ps);
  EXPECT_NEAR(alpha, 1 + elastic * std::pow((Ps - p) / (Ps - Pe), 2), 1e-12);
  const double of_solid =
      hugoniot(J_s) * (1 - Gamma * (1 - J_s) / 2) + Gamma * alpha_0 * s.energy();
  EXPECT_NEAR(alpha * p / of_solid, 1, 1e-10);
  // The heat is what the body received: solid along its isentrope, work of the pores.
  EXPECT_GT(s.temperature(), 298 * std::exp(Gamma * (1 - J_s)));
  const double received = s.energy();
  double J = 0.9;
  while (s.pressure() > 0 && J < 1.1) ASSERT_EQ(s.step(pressed(J += 1e-4), 1e-3), std::nullopt);
  EXPECT_LT(J, 0.97);
  EXPECT_GT(s.energy(), 0.3 * received);
  EXPECT_NEAR(s.history(0), s.history(1), 1e-3);
}

// Pressed (in steps long and short, as by shocks) and let go (slowly) at random: each return to a
// volume finds no less energy there, alpha_u only falls, alpha p is the pressure of the solid.
TEST(PorousSolid, ClosedCyclesGiveNoEnergy) {
  std::mt19937 random(3);
  const auto drawn = [&] { return static_cast<double>(random()) / 4294967296.0; };
  for (int cycle = 0; cycle < 20; ++cycle) {
    MaterialSample s = porous_sample();
    double J = 1, before = 0;
    for (int visit = 0; visit < 5; ++visit) {
      const double turns[] = {0.7 + 0.35 * drawn(), 0.7 + 0.35 * drawn(), 1};
      for (const double to : turns) {
        const double from = J;
        const int steps = to < from ? 1 + static_cast<int>(200 * drawn() * drawn()) : 400;
        for (int n = 1; n <= steps; ++n) {
          const double unloaded = s.history(1);
          J = from + (to - from) * n / steps;
          ASSERT_EQ(s.step(pressed(J), 1e-6), std::nullopt);
          const double p = s.pressure(), alpha = s.history(0), J_s = J * alpha_0 / alpha;
          const double cold =
              J_s < 1 ? hugoniot(J_s) * (1 - Gamma * (1 - J_s) / 2) : solid_K * (1 - J_s);
          EXPECT_NEAR(alpha * p, cold + Gamma * alpha_0 * s.energy(), 1e-12 * solid_K);
          EXPECT_LE(s.history(1), unloaded);
          EXPECT_GE(alpha, 1);
          EXPECT_GT(s.wave_speed(), 0);
        }
      }
      EXPECT_GT(s.energy(), before - 1e-4 * Pe);
      before = s.energy();
    }
  }
}

// Warm at the start and held: Gamma rhoS c_v (T - T_0)/alpha but for the pores that this closes.
TEST(PorousSolid, WarmSolidPresses) {
  MaterialSample s = porous_sample(299);
  const double p_s = Gamma * rhoS * 150;
  // alpha p = p_s + K_s d alpha/alpha, d alpha = -k (alpha - 1) p
  const double closing = alpha_0 * (1 / K0 - alpha_0 / solid_K);
  EXPECT_NEAR(s.pressure() / (p_s / (alpha_0 + solid_K * closing / alpha_0)), 1, 1e-3);
}

// Simple shear: G gamma, then the yield stress; what is not stored heats the solid, which presses
// on its volume.
TEST(PorousSolid, YieldsInShear) {
  constexpr double G = 20e9, Y = 1e8, end = 0.05;
  MaterialSample s = {law("p_alpha",
                          porous + "<shear_modulus>20e9</shear_modulus>"
                                   "<yield_stress>1e8</yield_stress>",
                          porous_constants()),
                      porous_constants(), 1, 298};
  const auto sheared = [](double gamma) { return Matrix{1, gamma, 0, 0, 1, 0, 0, 0, 1}; };
  double work = 0, before = 0;
  for (int n = 1; n <= 5000; ++n) {
    const double gamma = end * n / 5000;
    ASSERT_EQ(s.step(sheared(gamma), 1e-6), std::nullopt);
    const double now = s.stress()[5];
    if (gamma < 0.9 * Y / (std::sqrt(3) * G)) {
      EXPECT_NEAR(now / (G * gamma), 1, 1e-9);
    }
    work += 0.5 * (before + now) * end / 5000;
    before = now;
  }
  const double p = s.pressure();
  EXPECT_NEAR(s.equivalent() / Y, 1, 1e-9);
  EXPECT_NEAR(s.energy() / work, 1, 2e-4);
  const double stored = Y * Y / (6 * G), heat = s.energy() - stored;
  // As pores close a little, the solid takes their place and cools.
  const double cooled = 298 * Gamma * (alpha_0 / s.history(0) - 1);
  EXPECT_NEAR((s.temperature() - 298 + cooled) / (heat / (14100 * 150.0)), 1, 1e-3);
  // alpha p = Gamma alpha0 e + K_s d alpha/alpha, d alpha = -k (alpha - 1) p
  const double closing = alpha_0 * (1 / K0 - alpha_0 / solid_K);
  EXPECT_NEAR(p / (Gamma * alpha_0 * heat / (alpha_0 + solid_K * closing / alpha_0)), 1, 2e-3);
}

TEST(PorousSolid, BadNumbersAreTold) {
  const auto told_of = [](const std::string& inside) {
    std::vector<Fault> faults;
    law_of_text("p_alpha", inside, porous_constants(), faults);
    return told(faults);
  };
  const std::string rest =
      "<T_0>298</T_0><C_0>2000</C_0><Gamma_0>1.2</Gamma_0><S_alpha>1.1</S_alpha>";
  EXPECT_THAT(told_of("<Ps>1</Ps><Pe>2</Pe><rhoS>16281</rhoS><K0>35e9</K0>" + rest),
              testing::AllOf(testing::HasSubstr("law.ups:3"),
                             testing::HasSubstr("<Ps> is 1, expected above <Pe> 2")));
  EXPECT_THAT(told_of("<Ps>6e9</Ps><Pe>1e8</Pe>\n<rhoS>14000</rhoS><K0>35e9</K0>" + rest),
              testing::AllOf(testing::HasSubstr("law.ups:4"),
                             testing::HasSubstr("<rhoS> is 14000, expected above the <density>")));
  EXPECT_THAT(told_of("<Ps>6e9</Ps><Pe>1e8</Pe><rhoS>16281</rhoS><K0>60e9</K0>" + rest),
              testing::HasSubstr("<K0> is 6e+10, expected below rhoS C_0^2/alpha0 = 5.6"));
  EXPECT_THAT(told_of(porous + "<Ks>241e9</Ks><alpha0>1.2</alpha0>"),
              testing::AllOf(testing::HasSubstr("warning"),
                             testing::HasSubstr("<alpha0> is 1.2, but <rhoS>/<density> = 1.15468"),
                             testing::HasSubstr("<Ks> is 2.41e+11, but <rhoS> <C_0>^2")));
}

const std::string standard_solid =
    "<e_shear_modulus>6e3</e_shear_modulus><e_bulk_modulus>16e3</e_bulk_modulus>"
    "<ve_shear_modulus>1e4</ve_shear_modulus><ve_bulk_modulus>2e4</ve_bulk_modulus>"
    "<ve_deviatoric_viscosity>1e3</ve_deviatoric_viscosity>"
    "<ve_volumetric_viscosity>4e3</ve_volumetric_viscosity>";

// A small step of strain, held: shear relaxes in 0.1 s, pressure in 0.2 s, whatever the steps.
TEST(MaxwellSolid, RelaxesToItsSpring) {
  const double e = 1e-7;
  for (const int steps : {1, 3, 50}) {
    MaterialSample s(law("mw_visco_elastic", standard_solid), steel_constants(), 1, 298);
    const Matrix F = {1 + e, 2 * e, 0, 0, 1, 0, 0, 0, 1};
    ASSERT_EQ(s.step(F, 1e-12), std::nullopt);
    follow(
        s, [&](double) { return F; }, 0.3 + s.time(), steps);
    const double G = 6e3 + 1e4 * std::exp(-3), K = 16e3 + 2e4 * std::exp(-1.5);
    EXPECT_NEAR(s.stress()[5] / (2 * G * e), 1, 1e-6);
    EXPECT_NEAR(-s.pressure() / (K * e), 1, 1e-6);
    EXPECT_NEAR((s.stress()[0] - s.stress()[1]) / (2 * G * e), 1, 1e-6);
  }
}

// At a constant rate the element comes to 2 eta D', and its pressure to eta_v tr D.
TEST(MaxwellSolid, FlowsWithItsViscosities) {
  MaterialSample s(law("mw_visco_elastic", standard_solid), steel_constants(), 1, 298);
  const double rate = 1e-8, end = 4;
  follow(
      s, [&](double t) { return Matrix{1 + rate * t, rate * t, 0, 0, 1, 0, 0, 0, 1}; }, end, 13);
  EXPECT_NEAR(s.stress()[5] / (6e3 * rate * end + 1e3 * rate), 1, 1e-6);
  EXPECT_NEAR(-s.pressure() / (16e3 * rate * end + 4e3 * rate), 1, 1e-6);
}

// Stretched and sheared to and fro, it takes energy and never gives more than it took.
TEST(MaxwellSolid, ClosedCyclesCostEnergy) {
  MaterialSample s(law("mw_visco_elastic", standard_solid), steel_constants(), 1, 298);
  double before = 0;
  for (int n = 0; n < 6; ++n) {
    follow(
        s,
        [&](double t) {
          const double x = 0.1 * std::sin(2 * 3.14159265358979323846 * t / 0.3);
          return Matrix{1 + x, 0.5 * x, 0, 0, 1, 0, 0, 0, 1};
        },
        0.3 * (n + 1), 60);
    EXPECT_GT(s.energy(), before);
    before = s.energy();
  }
}

const std::string binder =
    "<shear_modulus>3750</shear_modulus><bulk_modulus>10000</bulk_modulus>"
    "<deviatoric_stress_model type=\"hypoViscoElastic\"><mu>[3000,750]</mu><tau>[.1,.02]</tau>"
    "</deviatoric_stress_model>";
std::string yields_at(const std::string& stress) {
  return "<flow_model type=\"isotropic_hardening\"><K>0</K><sigma_Y>" + stress +
         "</sigma_Y></flow_model>";
}
Matrix sheared(double g) {
  return exponential({0, 0.5 * g, 0, 0.5 * g, 0, 0, 0, 0, 0});
}

// Held after a step of shear; what the deviator loses has become heat.
TEST(HypoViscoElastic, RelaxesAndWarms) {
  for (const int steps : {2, 100}) {
    MaterialSample s(law("elastic_plastic_hp", binder + yields_at("1e9")), steel_constants(), 1,
                     298);
    const double g = 1e-3;
    ASSERT_EQ(s.step(sheared(g), 1e-12), std::nullopt);
    EXPECT_NEAR(s.stress()[5] / (3750 * g), 1, 1e-7);
    const double stored = s.energy();
    follow(
        s, [&](double) { return sheared(g); }, 0.05 + s.time(), steps);
    const double left_1 = std::exp(-0.5), left_2 = std::exp(-2.5);
    EXPECT_NEAR(s.stress()[5] / ((3000 * left_1 + 750 * left_2) * g), 1, 1e-7);
    EXPECT_EQ(s.energy(), stored);
    const double still = 0.5 * (3000 * left_1 * left_1 + 750 * left_2 * left_2) * g * g;
    const double heat = 7830.0 * 477 * (s.temperature() - 298);
    EXPECT_NEAR(heat, stored - still, 1e-6 + 1e-5 * stored);  // round-off of 298 K: 2e-7
  }
}

// At a constant rate: 2 sum mu_i tau_i D' where it does not yield, its flow stress where it does.
TEST(HypoViscoElastic, FlowsBelowAndAtItsYieldStress) {
  const double rate = 0.5;
  MaterialSample s(law("elastic_plastic_hp", binder + yields_at("1e9")), steel_constants(), 1, 298);
  follow(
      s, [&](double t) { return sheared(rate * t); }, 2, 40);
  EXPECT_NEAR(s.stress()[5] / ((3000 * 0.1 + 750 * 0.02) * rate), 1, 2e-5);
  EXPECT_EQ(s.history(0), 0);
  MaterialSample yields(law("elastic_plastic_hp", binder + yields_at("173.2050807568877")),
                        steel_constants(), 1, 298);
  follow(
      yields, [&](double t) { return sheared(rate * t); }, 2, 4000);
  EXPECT_NEAR(yields.stress()[5], 100, 1e-9);
  // tau = 100 = sum mu_i tau_i (g' - g_p'): the dashpots take a share of the rate.
  const double plastic = rate - 100 / (3000 * 0.1 + 750 * 0.02);
  EXPECT_NEAR(std::sqrt(3.0) * yields.history(1) / plastic, 1, 1e-3);
}

TEST(HypoViscoElastic, BadListsAreTold) {
  const auto told_of = [](const std::string& part) {
    std::vector<Fault> faults;
    law_of_text("elastic_plastic_hp",
                "<shear_modulus>3750</shear_modulus><bulk_modulus>1e4</bulk_modulus>\n"
                "<deviatoric_stress_model type=\"hypoViscoElastic\">\n" +
                    part + "</deviatoric_stress_model>" + yields_at("1e9"),
                steel_constants(), faults);
    return told(faults);
  };
  EXPECT_THAT(told_of("<mu>[3750]</mu>\n<tau>[.1,.2]</tau>"),
              testing::AllOf(testing::HasSubstr("law.ups:6"),
                             testing::HasSubstr("<tau> has 2 numbers, expected 1")));
  EXPECT_THAT(told_of("<mu>[750]</mu>\n<tau>[.1]</tau>"),
              testing::AllOf(testing::HasSubstr("law.ups:5"),
                             testing::HasSubstr("the sum of <mu> is 750, expected <shear_modulus> "
                                                "3750")));
  EXPECT_THAT(told_of("<mu>[3750]</mu>\n<tau>[-.1]</tau>"),
              testing::HasSubstr("every number of <tau> must be greater than 0"));
}

}  // namespace
}  // namespace sluice::mpm::porous_and_relaxing
