// Numbers of the parts of metals: published constants, values worked out by hand from the papers'
// formulas (3 to 6 digits).
#include "mpm/material/base/metal_parts.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "mpm/material/base/plastic_root.hpp"
#include "mpm/material/metal/flow_johnson_cook.hpp"
#include "mpm/material/metal/flow_mts.hpp"
#include "mpm/material/metal/flow_preston_tonks_wallace.hpp"
#include "mpm/material/metal/flow_steinberg_guinan.hpp"
#include "mpm/material/metal/flow_zerilli_armstrong.hpp"
#include "mpm/material/metal/metal_failure.hpp"
#include "mpm/material/metal/metal_moduli.hpp"
#include "mpm/material/metal/metal_pressure.hpp"
#include "mpm/material/test_support/law_test_support.hpp"

namespace sluice::mpm::metal_parts {
namespace {

MetalState state_at(double T, double mu = 46e9, double melt = 1356, double rho = 8930) {
  MetalState s;
  s.temperature = T;
  s.shear = mu;
  s.melt = melt;
  s.density = rho;
  return s;
}

template <class Flow>
double stress(const Flow& flow, const MetalState& s, double strain, double rate) {
  return flow.stress(flow.at(s), strain, rate);
}

TEST(JohnsonCook, SteelAndCopper) {
  const JohnsonCook steel = {792e6, 510e6, 0.014, 0.26, 1.03, 298, 1793, 1};
  EXPECT_NEAR(stress(steel, state_at(298), 0.1, 1e3), 1.17596e9, 1e4);
  EXPECT_EQ(stress(steel, state_at(1800), 0.1, 1e3), 0);
  EXPECT_EQ(stress(steel, state_at(298), 0, 1e-5), 792e6);
  const JohnsonCook copper = {89.6e6, 292e6, 0.025, 0.31, 1.09, 294, 1356, 1};
  EXPECT_NEAR(stress(copper, state_at(294), 0.3, 1e4), 357.57e6, 1e4);
  EXPECT_NEAR(stress(copper, state_at(718), 0.3, 1e4), 226.13e6, 1e4);
}

TEST(MechanicalThreshold, Aluminium6061) {
  const MechanicalThreshold al = {363.7e6, 28e9, 4.5e9, 294, 0.823e6, 0,    0.71,    0,
                                  2.79e9,  0,    0,     1,   2,       0,    211.8e6, 0,
                                  0,       0,    0,     2,   3.42e8,  0.15, 1679.3e6};
  // mu = 25.325 GPa, sigma_e = 20.56 MPa, sigma_es = 737.6 MPa
  EXPECT_NEAR(stress(al, state_at(298), 0.1, 1e3), 373.93e6, 2e4);
}

// The table of a read law against the integration of one that was put together by hand.
TEST(MechanicalThreshold, TableIsTheIntegral) {
  const auto node = read_deck_text(
      "<Uintah_specification><sigma_a>40e6</sigma_a><mu_0>51.3e9</mu_0><D>3e9</D><T_0>165</T_0>"
      "<koverbcubed>.823e6</koverbcubed><g_0e>1.6</g_0e><edot_0e>1e7</edot_0e><p_e>.666667</p_e>"
      "<q_e>1</q_e><a_0>2390e6</a_0><alpha>2</alpha><edot_es0>1e7</edot_es0><g_0es>.2625</g_0es>"
      "<sigma_es0>770e6</sigma_es0></Uintah_specification>",
      "f");
  std::vector<Fault> faults;
  const Tags tags = MechanicalThreshold::tags();
  const Parameters p(*node.root, "mts_model", tags, {}, faults);
  const MechanicalThreshold read = MechanicalThreshold::read(p);
  MechanicalThreshold integrated = read;
  integrated.table.clear();
  // Strains where four steps of the integration are exact enough.
  for (const double strain : {1e-4, 0.01, 0.1, 0.3})
    EXPECT_NEAR(
        stress(read, state_at(400), strain, 1e3) / stress(integrated, state_at(400), strain, 1e3),
        1, strain < 0.2 ? 1e-5 : 1e-3);  // measured 3.5e-6, 1e-4
  // Saturated: sigma_e = sigma_es.
  EXPECT_NEAR(stress(read, state_at(400), 100, 1e3) / stress(read, state_at(400), 50, 1e3), 1,
              1e-6);
}

TEST(PrestonTonksWallace, Copper) {
  const PrestonTonksWallace cu = {0.025, 2.0,  0.0085, 0.00055, 0.11, 1e-5,
                                  1e-4,  1e-4, 0.094,  0.575,   0.25, 63.54 * 1.66053906660e-27};
  const auto mu = [](double T) { return 518e8 * (1 - 0.2 * T / 1356); };
  EXPECT_NEAR(stress(cu, state_at(294, mu(294)), 0.3, 1e4), 408.21e6, 2e4);
  EXPECT_NEAR(stress(cu, state_at(718, mu(718)), 0.3, 1e4), 318.84e6, 2e4);
  EXPECT_NEAR(stress(cu, state_at(294, mu(294)), 0, 1e4), 51.84e6, 2e4);
}

// The rate equation of the thermal part, put the other way round.
TEST(SteinbergGuinan, ThermalPartSolvesItsRateEquation) {
  SteinbergGuinan g = {47.7e9, 0.125e9, 0.64e9, 36, 0.45, 0};
  EXPECT_NEAR(stress(g, state_at(300, 47.7e9), 0.2, 1e4), 0.125e9 * std::pow(1 + 36 * 0.2, 0.45),
              1);
  EXPECT_EQ(stress(g, state_at(300, 47.7e9), 100, 1e4), 0.64e9);
  g.C1 = 0.71e6;
  g.C2 = 0.012e6;
  g.kink_pair = 0.31;
  g.boltzmann = 8.617385e-5;
  g.peierls = 0.5e8;
  for (const double rate : {1.0, 1e2, 1e3}) {
    const double sigma = g.thermal(400, rate), left = 1 - sigma / g.peierls;
    const double back =
        1 / (std::exp(2 * 0.31 / (8.617385e-5 * 400) * left * left) / g.C1 + g.C2 / sigma);
    EXPECT_NEAR(back / rate, 1, 1e-9);
  }
  EXPECT_NEAR(g.thermal(400, 1e9), g.peierls, 1);  // no more than the Peierls stress
}

// OFHC copper (Zerilli and Armstrong 1987): 65 MPa + 890 MPa eps^.5 exp(-a T),
// a = .0028 - .000115 ln rate.
TEST(ZerilliArmstrong, Copper) {
  const ZerilliArmstrong za = {65e6, 0, 0, 0, 0, 0, 890e6, 0.0028, 0.000115};
  EXPECT_NEAR(stress(za, state_at(300), 0.25, 1e3),
              65e6 + 890e6 * 0.5 * std::exp(-300 * (0.0028 - 0.000115 * std::log(1e3))), 1);
  EXPECT_NEAR(stress(za, state_at(300), 0.25, 1e3), 308.8e6, 0.1e6);
}

TEST(ShearModulus, PublishedForms) {
  ShearModulus mts;
  mts.form = ShearModulus::Form::mts;
  mts.mu_0 = 28e9;
  mts.D = 4.5e9;
  mts.T_0 = 294;
  const double expected[][2] = {{77, 27.899e9}, {294, 25.381e9}, {600, 20.883e9}, {1000, 14.834e9}};
  for (const auto& [T, mu] : expected) EXPECT_NEAR(mts(state_at(T)), mu, 1e6);
  // Copper: 47.7 GPa at 300 K, -B (T - 300), + A p.
  ShearModulus scg;
  scg.form = ShearModulus::Form::scg;
  scg.mu_0 = 47.7e9;
  scg.A = 28e-12;
  scg.B = 3.8e-4;
  MetalState pressed = state_at(500);
  pressed.pressure = 10e9;
  pressed.compression = 1.06;
  EXPECT_NEAR(scg(pressed), 47.7e9 * (1 + 0.28 / std::cbrt(1.06) - 0.076), 1e3);
  // Nadal and Le Poac: mu_0 at 0 K, nothing beyond 1 + zeta.
  ShearModulus np;
  np.form = ShearModulus::Form::np;
  np.mu_0 = 50.7e9;
  np.zeta = 0.04;
  np.C = 0.057;
  np.atom = 63.55 * 1.66e-27;
  EXPECT_NEAR(np(state_at(1e-3)) / 50.7e9, 1, 1e-4);
  EXPECT_LE(np(state_at(1356 * 1.05)), 1e-6 * 50.7e9 * 1.001);
  EXPECT_GT(np(state_at(300)), np(state_at(900)));
}

TEST(MeltingTemperature, SteinbergsForm) {
  MeltingTemperature melt;
  melt.form = MeltingTemperature::Form::scg;
  melt.T_m0 = 2310;
  melt.Gamma_0 = 3;
  melt.a = 1.67;
  MetalState s = state_at(300);
  EXPECT_NEAR(melt(s), 2310, 1e-9);
  s.compression = 1.1;
  EXPECT_NEAR(melt(s), 3784.33, 0.01);
  s.compression = 1.2;
  EXPECT_NEAR(melt(s), 5797.01, 0.01);
}

TEST(SpecificHeat, CopperAndSteelNearHandbooks) {
  SpecificHeat copper;
  copper.form = SpecificHeat::Form::copper;
  EXPECT_NEAR(copper(298), 386, 4);  // handbook: 385 J/kg/K
  EXPECT_NEAR(copper(269.99), copper(270.01), 3);
  const auto made = law("elastic_plastic",
                        "<bulk_modulus>173e9</bulk_modulus><shear_modulus>80e9</shear_modulus>"
                        "<flow_model type=\"isotropic_hardening\"><sigma_Y>1e9</sigma_Y><K>0</K>"
                        "</flow_model><specific_heat_model type=\"steel_Cp\"/>");
  EXPECT_NE(made, nullptr);
}

// Copper, rho_0 8930, C_0 3940, Gamma_0 2.02, S 1.489.
TEST(MetalPressure, MieGrueneisen) {
  MetalPressure cu;
  cu.form = MetalPressure::Form::mie_gruneisen;
  cu.stiffness = 8930.0 * 3940 * 3940;
  cu.Gamma_0 = 2.02;
  cu.S_1 = 1.489;
  // Held at E = 0: the step has no change of volume.
  const auto cold = [&](double eta) { return cu({1 - eta, 1 - eta, 0, 0, 0, 300, 300}); };
  EXPECT_NEAR(cold(0.02).p, 2.885831e9, 1e3);
  EXPECT_NEAR(cold(0.1).p, 1.7204514e10, 1e4);
  EXPECT_NEAR(cold(-0.02).p, -2.772515e9, 1e3);
  EXPECT_FALSE(cold(0.68).good);  // beyond the pole at 1/S
  // One step from rest lands on the Hugoniot: p_H = rho_0 U_s u_p, U_s = C_0 + S u_p.
  const double u_p = 462.930, U_s = 3940 + 1.489 * u_p;
  const MetalPressure::Result shocked = cu({1, 1 - u_p / U_s, 0, 0, 0, 300, 300});
  EXPECT_NEAR(shocked.p, 8930 * U_s * u_p, 1e-9 * shocked.p);
  EXPECT_NEAR(shocked.p, 1.9137391e10, 1e5);
  // Its modulus: -J dp/dJ along the isentrope, by a difference of two small steps.
  const double h = 1e-5, J = 0.9, E = 0.5 * shocked.p * 0.1;
  const double more = cu({J, J - h, shocked.p, E, 0, 300, 300}).p;
  const double less = cu({J, J + h, shocked.p, E, 0, 300, 300}).p;
  EXPECT_NEAR(J * (more - less) / (2 * h) / cu({J, J, shocked.p, E, 0, 300, 300}).modulus, 1, 1e-6);
}

TEST(YieldCondition, GursonWithoutPoresIsVonMises) {
  const YieldCondition gurson = {true, 1.5, 1, 2.25, 4, 0.05};
  EXPECT_EQ(gurson.share(1e9, 3e8, 0), 1);
  // Gurson 1977 without pressure: 1 - q_1 f where q_3 = q_1^2.
  EXPECT_NEAR(gurson.share(1e9, 0, 0.02), 1 - 1.5 * 0.02, 1e-12);
  EXPECT_LT(gurson.share(1e9, 3e9, 0.02), gurson.share(1e9, 0, 0.02));
}

// J2 flow without hardening loses ellipticity in plane strain, not in axisymmetric tension
// (Rudnicki and Rice 1975: h_cr = 0 for N = (1, 0, -1)/sqrt 2, negative else).
TEST(Stability, BeckerAsRudnickiAndRice) {
  const double mu = 80e9, K = 170e9;
  const Symmetric D = {1, -1, 0, 0, 0, 0};
  const double r = std::sqrt(0.5), s = std::sqrt(1.0 / 6);
  const Symmetric shear = {r, -r, 0, 0, 0, 0}, tension = {2 * s, -s, -s, 0, 0, 0};
  EXPECT_FALSE(unstable(Stability::becker, D, shear, mu, K, 1e6));
  EXPECT_TRUE(unstable(Stability::becker, D, shear, mu, K, -1e6));
  // h_cr/mu = -(1 + nu)/9... of axisymmetric tension: (1 + nu)/(1 - nu) (..) is below -0.1.
  EXPECT_FALSE(unstable(Stability::becker, D, tension, mu, K, -1e9));
  EXPECT_TRUE(unstable(Stability::becker, D, tension, mu, K, -60e9));
  EXPECT_FALSE(unstable(Stability::drucker, D, shear, mu, K, 1e6));
  EXPECT_TRUE(unstable(Stability::drucker, D, shear, mu, K, -1e6));
  EXPECT_FALSE(unstable(Stability::none, D, shear, mu, K, -1e9));
}

TEST(FallingRoot, EndsForSteepAndSteppedFunctions) {
  const auto steep = [](double x) {
    return 1 - 0.5 * x - 0.1 * std::log(std::max(x, 1e-12) / 1e-12);
  };
  const double x = falling_root(steep, 1, 2, 1e-5, 1e-13);
  EXPECT_NEAR(steep(x), 0, 1e-13);
  const auto stepped = [](double y) { return y < 0.3 ? 1.0 : -1.0; };
  EXPECT_NEAR(falling_root(stepped, 1, 2, 0, 1e-13), 0.3, 1e-14);
  EXPECT_EQ(falling_root([](double) { return 1.0; }, 1, 2, 0, 1e-13), 2);
}

}  // namespace
}  // namespace sluice::mpm::metal_parts
