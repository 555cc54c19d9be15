// Metals on paths with known stress, heat and pressure.
#include <cmath>

#include "mpm/material/test_support/law_test_support.hpp"

namespace sluice::mpm::elastic_plastic {
namespace {

const std::string moduli =
    "<bulk_modulus>173.33e9</bulk_modulus><shear_modulus>80e9</shear_modulus>";
const std::string linear =
    "<flow_model type=\"isotropic_hardening\"><sigma_Y>792e6</sigma_Y><K>510e6</K></flow_model>";
const std::string steel =
    "<flow_model type=\"johnson_cook\"><A>792e6</A><B>510e6</B><C>.014</C><n>.26</n><m>1.03</m>"
    "</flow_model>";
constexpr double K = 173.33e9, mu = 80e9;

Motion shear_path(double rate) {
  return [rate](double t) {
    return exponential({0, rate * t / 2, 0, rate * t / 2, 0, 0, 0, 0, 0});
  };
}

// Pure shear, linear hardening: tau = (sigma_Y + K eps_p)/sqrt 3, eps_p = (g - tau/mu)/sqrt 3.
TEST(Metal, PureShearHardensLinearly) {
  MaterialSample s(law("elastic_plastic", moduli + linear), steel_constants(), 1, 298);
  s.keep_temperature(true);
  follow(s, shear_path(0.1), 1, 200);
  const double tau = (792e6 / std::sqrt(3.0) + 510e6 * 0.1 / 3) / (1 + 510e6 / (3 * mu));
  EXPECT_NEAR(s.stress()[5] / tau, 1, 1e-6);  // measured 2e-7
  EXPECT_NEAR(s.history(0), (0.1 - tau / mu) / std::sqrt(3.0), 1e-6);
  EXPECT_NEAR(s.equivalent(), 792e6 + 510e6 * s.history(0), 1e-9 * K);
}

// Uniaxial strain beyond the Hugoniot elastic limit: sigma_11 = K eps + 2/3 sigma_Y.
TEST(Metal, UniaxialStrain) {
  const std::string perfect =
      "<flow_model type=\"isotropic_hardening\"><sigma_Y>792e6</sigma_Y><K>0</K></flow_model>";
  MaterialSample s(law("elastic_plastic", moduli + perfect), steel_constants(), 1, 298);
  const double e = -0.02;
  follow(
      s, [&](double t) { return Matrix{std::exp(e * t), 0, 0, 0, 1, 0, 0, 0, 1}; }, 1, 100);
  EXPECT_NEAR(s.stress()[0], K * e - 2.0 / 3 * 792e6, 1e-9 * K);
  EXPECT_NEAR(s.stress()[1], K * e + 1.0 / 3 * 792e6, 1e-9 * K);
}

// The stress that a metal is sheared under at a constant rate is that of its flow law.
TEST(Metal, FollowsJohnsonCook) {
  MaterialSample s(law("elastic_plastic", moduli + steel), steel_constants(), 1, 298);
  s.keep_temperature(true);
  const double rate = 1e3;  // of eps_p, once the elastic part stands
  follow(s, shear_path(std::sqrt(3.0) * rate), 2e-4, 2000);
  const double strain = s.history(0);
  const double flow =
      (792e6 + 510e6 * std::pow(strain, 0.26)) * (1 + 0.014 * std::log(s.history(1)));
  EXPECT_NEAR(s.history(1) / rate, 1, 3e-3);  // less the elastic rate: measured 2e-3
  EXPECT_NEAR(s.equivalent() / flow, 1, 1e-10);
}

// Taylor and Quinney: 90 % of the plastic work warms the body.
TEST(Metal, PlasticWorkBecomesHeat) {
  MaterialSample s(law("elastic_plastic", moduli + steel), steel_constants(), 1, 298);
  follow(s, shear_path(1e3), 5e-4, 2000);
  const double tau = s.stress()[5], elastic = 0.5 * tau * tau / mu;
  const double heat = 7830.0 * 477 * (s.temperature() - 298);
  EXPECT_NEAR(heat / (0.9 * (s.energy() - elastic)), 1, 2e-3);  // first order in the step
  EXPECT_GT(s.temperature(), 370);
}

// A shock through Mie-Grueneisen copper without strength: on its Hugoniot, and the isentrope warms
// by T = T_0 exp(Gamma_0 (1 - J)) where it is followed in small steps.
TEST(Metal, HugoniotAndIsentrope) {
  MaterialConstants copper = steel_constants();
  copper.density = 8930;
  const std::string soft =
      "<bulk_modulus>138e9</bulk_modulus><shear_modulus>46e9</shear_modulus>"
      "<flow_model type=\"isotropic_hardening\"><sigma_Y>1</sigma_Y><K>0</K></flow_model>"
      "<equation_of_state type=\"mie_gruneisen\"><C_0>3940</C_0><Gamma_0>2.02</Gamma_0>"
      "<S_alpha>1.489</S_alpha></equation_of_state>";
  MaterialSample shocked(law("elastic_plastic", soft, copper), copper, 1, 298);
  ASSERT_EQ(shocked.step({0.9, 0, 0, 0, 1, 0, 0, 0, 1}, 1e-6), std::nullopt);
  EXPECT_NEAR(shocked.pressure() / 1.9137391e10, 1, 1e-6);
  MaterialSample slow(law("elastic_plastic", soft, copper), copper, 1, 298);
  follow(
      slow, [](double t) { return Matrix{1 - 0.1 * t, 0, 0, 0, 1, 0, 0, 0, 1}; }, 1, 1000);
  EXPECT_NEAR(slow.temperature(), 298 * std::exp(2.02 * 0.1), 0.01);
  EXPECT_LT(slow.pressure(), shocked.pressure());
  const auto fault = slow.step({0.3, 0, 0, 0, 1, 0, 0, 0, 1}, 1e-6);
  ASSERT_TRUE(fault);
  EXPECT_STREQ(fault->reason, "past the pole of Mie-Grueneisen");
}

TEST(Metal, MeltedMetalIsALiquid) {
  MaterialSample s(law("elastic_plastic", moduli + steel), steel_constants(), 1, 1800);
  ASSERT_EQ(s.step({1, 0.1, 0, 0, 1, 0, 0, 0, 1}, 1e-3), std::nullopt);
  EXPECT_EQ(s.stress()[5], 0);
  EXPECT_EQ(s.equivalent(), 0);
}

// Pores nucleate around a plastic strain of .3 and weaken the metal.
TEST(Metal, PoresOfGurson) {
  const std::string porous =
      "<yield_condition type=\"gurson\"><q1>1.5</q1><q2>1</q2><q3>2.25</q3><k>4</k><f_c>.05</f_c>"
      "</yield_condition><initial_mean_porosity>.005</initial_mean_porosity>";
  MaterialSample s(law("elastic_plastic", moduli + linear + porous), steel_constants(), 1, 298);
  s.keep_temperature(true);
  const auto strain = [&] { return s.history(0); };
  follow(s, shear_path(1), 1, 1000);
  // Integral of the normal distribution: f_n [Phi((eps - eps_n)/s_n) - Phi(-eps_n/s_n)].
  const auto Phi = [](double x) { return 0.5 * std::erfc(-x / std::sqrt(2.0)); };
  const double nucleated = 0.1 * (Phi((strain() - 0.3) / 0.1) - Phi(-3));
  EXPECT_NEAR(s.history(3), 0.005 + nucleated, 2e-4);
  const double f = s.history(3), star = 0.05 + 4 * (f - 0.05);
  EXPECT_NEAR(s.equivalent() / ((792e6 + 510e6 * strain()) * (1 - 1.5 * star)), 1, 2e-3);
}

TEST(Metal, MissingAndUnknownPartsAreTold) {
  std::vector<Fault> faults;
  EXPECT_EQ(law_of_text("elastic_plastic", moduli, steel_constants(), faults), nullptr);
  EXPECT_NE(told(faults).find("elastic_plastic needs <flow_model>"), std::string::npos);
  faults.clear();
  EXPECT_EQ(law_of_text("elastic_plastic", moduli + "\n<flow_model type=\"jonson_cook\"/>",
                        steel_constants(), faults),
            nullptr);
  EXPECT_NE(told(faults).find("did you mean 'johnson_cook'?"), std::string::npos) << told(faults);
  EXPECT_NE(told(faults).find("law.ups:4"), std::string::npos);
  faults.clear();
  EXPECT_EQ(law_of_text("elastic_plastic",
                        moduli + "<flow_model type=\"johnson_cook\"><A>1</A></flow_model>",
                        steel_constants(), faults),
            nullptr);
  EXPECT_NE(told(faults).find("johnson_cook needs <B>"), std::string::npos) << told(faults);
}

}  // namespace
}  // namespace sluice::mpm::elastic_plastic
