// Paths of rock whose stress is known in closed form.
#include <cmath>

#include "mpm/material/test_support/law_test_support.hpp"

namespace sluice::mpm::arenisca {
namespace {

MaterialConstants rock() {
  MaterialConstants c;
  c.density = 2000;
  return c;
}

// K = 10,000, G = 3,750; J2^(1/2) <= .0577 (612 - I).
const std::string cone =
    "<B0>10000</B0><G0>3750</G0><PEAKI1>612.3724356953976</PEAKI1><FSLOPE>.057735026919</FSLOPE>";
const std::string shear_only =
    "<B0>10000</B0><G0>3750</G0><PEAKI1>35.355339059327378e10</PEAKI1><FSLOPE>1e-10</FSLOPE>";
const std::string fixed_cap =
    "<p0_crush_curve>-1837.0724</p0_crush_curve><p1_crush_curve>-1e99</p1_crush_curve>"
    "<p3_crush_curve>.5</p3_crush_curve>";
const std::string no_cap =
    "<p0_crush_curve>-1e99</p0_crush_curve><p1_crush_curve>-1e99</p1_crush_curve>"
    "<p3_crush_curve>.5</p3_crush_curve>";
const std::string crushed =
    "<p0_crush_curve>-1837.0724</p0_crush_curve>"
    "<p1_crush_curve>6.6666666666666666e-4</p1_crush_curve><p3_crush_curve>.5</p3_crush_curve>";

MaterialSample sample(const std::string& type, const std::string& inside) {
  return {law(type, inside, rock()), rock(), 1, 298};
}
Matrix diagonal(double x, double y, double z) {
  return {x, 0, 0, 0, y, 0, 0, 0, z};
}
double root_J2(const MaterialSample& s) {
  return s.equivalent() / std::sqrt(3.0);
}

// Without slope and cap it is von Mises: uniaxial strain to and fro.
TEST(Arenisca3, IsVonMisesWithoutSlope) {
  MaterialSample s = sample("Arenisca3", shear_only + no_cap + "<CR>.5</CR>");
  const double k = 35.355339059327378;
  follow(
      s, [](double t) { return diagonal(std::exp(-0.03 * t), 1, 1); }, 1, 200);
  EXPECT_NEAR(s.stress()[0] - s.stress()[1], -std::sqrt(3) * k, 1e-6 * k);
  EXPECT_NEAR(s.pressure(), 300, 1e-3);
  follow(
      s, [](double t) { return diagonal(std::exp(-0.03 * (2 - t)), 1, 1); }, 2, 200);
  EXPECT_NEAR(s.stress()[0] - s.stress()[1], std::sqrt(3) * k, 1e-6 * k);
  EXPECT_NEAR(s.pressure(), 0, 1e-3);
}

// Pulled in all directions it bears PEAKI1, pressed with a cap that holds p0.
TEST(Arenisca3, EndsAtVertexAndCap) {
  MaterialSample pulled = sample("Arenisca3", cone + fixed_cap + "<CR>.5</CR>");
  follow(
      pulled, [](double t) { return diagonal(1 + 0.1 * t, 1 + 0.1 * t, 1 + 0.1 * t); }, 1, 50);
  EXPECT_NEAR(-3 * pulled.pressure(), 612.3724356953976, 1e-9 * 612);
  MaterialSample pressed = sample("Arenisca3", cone + fixed_cap + "<CR>.5</CR>");
  follow(
      pressed, [](double t) { return diagonal(1 - 0.07 * t, 1 - 0.07 * t, 1 - 0.07 * t); }, 1, 50);
  EXPECT_NEAR(-3 * pressed.pressure(), -1837.0724, 1e-9 * 1837);
  EXPECT_NEAR(root_J2(pressed), 0, 1e-9);
}

// Crushed by pressure: 3 K (e - e_p) = p0 + ln(1 + e_p/p3)/p1, whatever the steps.
TEST(Arenisca, CrushesAlongItsCurve) {
  for (const char* type : {"Arenisca", "Arenisca3", "Arenisca4"}) {
    const std::string flow =
        type == std::string("Arenisca") ? "<FSLOPE_p>.057735026919</FSLOPE_p>" : "";
    for (const int steps : {20, 200}) {
      MaterialSample s = sample(type, cone + crushed + flow + "<CR>.5</CR>");
      follow(
          s,
          [](double t) {
            const double l = 1 - 0.2 * t;
            return diagonal(l, l, l);
          },
          1, steps);
      const double e_p = s.history(0), I = -3 * s.pressure();
      EXPECT_LT(e_p, -0.2);
      EXPECT_NEAR(I, -1837.0724 + std::log1p(e_p / 0.5) / 6.6666666666666666e-4, 1e-8 * 4000);
      EXPECT_NEAR(I, 3e4 * (3 * std::log(0.8) - e_p), (steps == 20 ? 1e-1 : 1e-3) * 30);
      EXPECT_NEAR(s.history(1), 3 * std::log(0.8) - e_p, 1e-14);
    }
  }
}

// On the cone the plastic strain is normal to it: tr d e^p/|dev d e^p| = 18^(1/2) FSLOPE beta^2.
TEST(Arenisca3, FlowsNormalToTheConeOrLess) {
  for (const double beta : {1.0, 0.6}) {
    MaterialSample s = sample("Arenisca3", cone + no_cap + "<CR>.5</CR><BETA_nonassociativity>" +
                                               std::to_string(beta) + "</BETA_nonassociativity>");
    follow(
        s, [](double t) { return diagonal(std::exp(-0.05 * t), 1, 1); }, 1, 100);
    EXPECT_NEAR(root_J2(s), 0.057735026919 * (612.3724356953976 + 3 * s.pressure()), 1e-9 * 35);
    const double shear = std::sqrt(1.5) * s.history(3);  // |d e^p|
    EXPECT_NEAR(s.history(0) / shear, std::sqrt(18) * 0.057735026919 * beta * beta, 1e-7);
  }
}

// Linear isotropic hardening of J2^(1/2) and Prager's rule, uniaxial strain: both are exact however
// great the step. With e = |e_axial| and plastic shear h: |s| = 2 G (sqrt(2/3) e - h).
TEST(Arenisca, HardensInShear) {
  const double k = 35.355339059327378, G = 3750, e = 0.03;
  const std::string plain = shear_only + no_cap + "<CR>1</CR><FSLOPE_p>1e-10</FSLOPE_p>";
  const auto squeezed = [&](const std::string& more, int steps) {
    MaterialSample s = sample("Arenisca", plain + more);
    follow(
        s, [&](double t) { return diagonal(std::exp(-e * t), 1, 1); }, 1, steps);
    return std::sqrt(2.0) * root_J2(s);
  };
  const double elastic = 2 * G * std::sqrt(2.0 / 3) * e;
  for (const int steps : {1, 50}) {
    // |s|/sqrt(2) = k + H sqrt(2/3) h
    const double H = 760, h = (elastic - std::sqrt(2.0) * k) / (2 * G + H * std::sqrt(4.0 / 3));
    EXPECT_NEAR(squeezed("<hardening_modulus>760</hardening_modulus>", steps), elastic - 2 * G * h,
                (steps == 1 ? 2e-2 : 1e-4) * k);
    // |s| - c h = sqrt(2) k
    const double c = 30, hc = (elastic - std::sqrt(2.0) * k) / (2 * G + c);
    EXPECT_NEAR(squeezed("<kinematic_hardening_constant>30</kinematic_hardening_constant>", steps),
                elastic - 2 * G * hc, (steps == 1 ? 2e-2 : 1e-4) * k);
  }
}

// Turned back, kinematic hardening yields early (Bauschinger): 2 sqrt(2) k between the two sides.
TEST(Arenisca, BackStressMovesTheSurface) {
  MaterialSample s = sample("Arenisca", shear_only + no_cap +
                                            "<CR>1</CR><FSLOPE_p>1e-10</FSLOPE_p>"
                                            "<kinematic_hardening_constant>300"
                                            "</kinematic_hardening_constant>");
  follow(
      s, [](double t) { return diagonal(std::exp(-0.03 * t), 1, 1); }, 1, 100);
  const double before = s.stress()[0] - s.stress()[1];
  // 2 G de = sqrt(2) 2 k sqrt(3/2)... of the difference sigma_1 - sigma_2 = sqrt(3) sqrt(J2)
  const double k = 35.355339059327378, de = 2 * std::sqrt(3.0) * k / (2 * 3750);
  follow(
      s, [&](double t) { return diagonal(std::exp(-0.03 + 0.999 * de * (t - 1)), 1, 1); }, 2, 100);
  EXPECT_NEAR(s.stress()[0] - s.stress()[1] - before, 0.999 * 2 * std::sqrt(3.0) * k, 1e-3 * k);
}

// Pressed with full pores. B2 is so great that B1 stiffens the matrix alone: K_m = 30,000.
TEST(Arenisca3, FluidBearsWhatTheFrameDoesNot) {
  const auto pressed = [](const std::string& cap, double from, double to, const char* fluid) {
    MaterialSample s = sample("Arenisca3", cone + cap + "<CR>.5</CR><B1>20000</B1><B2>1e9</B2>" +
                                               "<fluid_B0>" + fluid + "</fluid_B0>");
    const auto at = [&](double t) {
      const double l = std::exp(-to * t / 3);
      return diagonal(l, l, l);
    };
    follow(s, at, from / to, 300);
    const double before = s.pressure();
    follow(s, at, 1, 100);
    return (s.pressure() - before) / (to - from);
  };
  const double phi = 1 - std::exp(-0.5);
  // Before the pores give way: Gassmann.
  const double a = 1.0 / 3;
  const double K = 10000 + (1 - a) * (1 - a) / (phi / 3000 + (1 - phi) / 30000 - a / 30000);
  EXPECT_NEAR(pressed(fixed_cap, 0.005, 0.01, "3000") / K, 1, 1e-6);
  // A frame that yields at its stress: matrix and fluid side by side.
  const double reuss = 1 / (phi / 3000 + (1 - phi) / 30000);
  EXPECT_NEAR(pressed(fixed_cap, 0.075, 0.08, "3000") / reuss, 1, 0.02);
  // A fluid of almost the matrix' stiffness: no pore closes.
  const double both = 1 / (phi / 29000 + (1 - phi) / 30000);
  EXPECT_NEAR(pressed(crushed, 0.1, 0.2, "29000") / both, 1, 1e-3);
  EXPECT_LT(pressed(crushed, 0.1, 0.2, "0"), 6000);
}

// Fluid and body begin at one pressure.
TEST(Arenisca3, BeginsAtThePressureOfItsFluid) {
  const MaterialSample s =
      sample("Arenisca3", cone + crushed +
                              "<CR>.5</CR><B1>20000</B1><fluid_B0>3000</fluid_B0>"
                              "<fluid_pressure_initial>300</fluid_pressure_initial>");
  EXPECT_NEAR(s.pressure(), 300, 1e-9);
}

// Duvaut and Lions at a steady rate: the stress is ahead of the surface by 2 G e_dot' tau.
TEST(Arenisca3, TrailsItsRestStress) {
  MaterialSample s = sample("Arenisca3", shear_only + no_cap +
                                             "<CR>.5</CR><T1_rate_dependence>.02"
                                             "</T1_rate_dependence>"
                                             "<T2_rate_dependence>0</T2_rate_dependence>");
  follow(
      s, [](double t) { return diagonal(std::exp(-0.3 * t), 1, 1); }, 1, 400);
  const double ahead = 2 * 3750 * std::sqrt(2.0 / 3) * 0.3 * 0.02 / std::sqrt(2.0);
  EXPECT_NEAR(root_J2(s), 35.355339059327378 + ahead, 1e-3 * ahead);
  // Held, it sinks to the surface with tau.
  const double over = root_J2(s) - 35.355339059327378;
  const Matrix held = s.F();
  follow(
      s, [&](double) { return held; }, 1.04, 3);
  EXPECT_NEAR(root_J2(s) - 35.355339059327378, over * std::exp(-2), 1e-6 * over);
}

// Random closed walks through strain: a cycle gives no work away.
TEST(Arenisca3, ClosedWalksCostWork) {
  for (unsigned seed = 1; seed <= 6; ++seed) {
    MaterialSample s = sample("Arenisca3", cone + crushed + "<CR>.5</CR>");
    const double a = 0.02 + 0.01 * seed, b = 0.05 / seed;
    const auto walk = [&](double t) {
      const double w = 6.283185307179586 * t;
      return Matrix{1 - a * (1 - std::cos(w)),
                    b * std::sin(w),
                    0,
                    0.5 * b * std::sin(2 * w),
                    1 - b * (1 - std::cos(w)),
                    0,
                    0,
                    0,
                    1 + a * std::sin(w)};
    };
    double least = 0;
    for (int cycle = 0; cycle < 3; ++cycle) {
      const double before = s.energy();
      follow(s, walk, cycle + 1, 400);
      least = std::min(least, s.energy() - before);
    }
    EXPECT_GE(least, -1e-6) << seed;
  }
}

TEST(Arenisca3, TellsWhatItIsNot) {
  std::vector<Fault> faults;
  law_of_text("Arenisca3", cone + fixed_cap + "<CR>.5</CR><STREN>5</STREN><YSLOPE>1</YSLOPE>",
              rock(), faults);
  EXPECT_NE(told(faults).find("do not give a limit curve"), std::string::npos) << told(faults);
  faults.clear();
  law_of_text("Arenisca3", cone + fixed_cap + "<CR>.5</CR><G1>.2</G1>", rock(), faults);
  EXPECT_NE(told(faults).find("<G1>"), std::string::npos) << told(faults);
  faults.clear();
  law_of_text("Arenisca", cone + crushed + "<CR>.5</CR><FSLOPE_p>.1</FSLOPE_p>", rock(), faults);
  EXPECT_NE(told(faults).find("<FSLOPE_p> must be"), std::string::npos) << told(faults);
}

}  // namespace
}  // namespace sluice::mpm::arenisca
