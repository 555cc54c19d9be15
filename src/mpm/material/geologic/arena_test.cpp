// Paths of soil against the equations that its law must keep.
#include <cmath>
#include <cstdio>

#include "mpm/material/geologic/wet_soil.hpp"
#include "mpm/material/test_support/law_test_support.hpp"

namespace sluice::mpm::arena {
namespace {

enum {
  e_v,
  e_e,
  e_q,
  e_q_again,
  cap,
  zeta,
  share,
  saturation,
  grown,
  coherence,
  peak,
  fslope,
  stren,
  quiet = 14
};

MaterialConstants soil_constants() {
  MaterialConstants c;
  c.density = 1500;
  return c;
}

struct Given {
  double S = 0, p0 = 1e6, pressure = 0, nu = 0.35, PEAKI1 = 1e5, FSLOPE = 0.453, STREN = 1e7,
         YSLOPE = 0.31, beta = 1, T1 = 0, T2 = 0;
  std::string more;
};

std::string text_of(const Given& g) {
  const auto t = [](const char* name, double value) {
    char text[99];
    std::snprintf(text, sizeof text, "<%s>%.17g</%s>", name, value, name);
    return std::string(text);
  };
  return t("initial_porosity", 0.4) + t("initial_saturation", g.S) +
         t("initial_fluid_pressure", g.pressure) + t("p0", g.p0) +
         "<p1>482.68e6</p1><p1_sat>1</p1_sat><p2>.719</p2><p3>.5108256</p3>"
         "<elastic_moduli_model type='arena'><b0>.0029</b0><b1>.4731</b1><b2>1.5057</b2>"
         "<b3>2.5728</b3><b4>2.0799</b4><G0>7e8</G0>" +
         t("nu1", g.nu) +
         "<nu2>0</nu2></elastic_moduli_model><plastic_yield_condition type='arena'>" +
         t("PEAKI1", g.PEAKI1) + t("FSLOPE", g.FSLOPE) + t("STREN", g.STREN) +
         t("YSLOPE", g.YSLOPE) + t("BETA", g.beta) + "<CR>.5</CR>" + t("T1", g.T1) + t("T2", g.T2) +
         "</plastic_yield_condition>" + g.more;
}

MaterialSample sample(const Given& g) {
  return {law("ArenaSoil", text_of(g), soil_constants()), soil_constants(), 1, 298};
}
Matrix diagonal(double x, double y, double z) {
  return {x, 0, 0, 0, y, 0, 0, 0, z};
}
double root_J2(const MaterialSample& s) {
  return s.equivalent() / std::sqrt(3.0);
}
// Trace of the stress that grains bear.
double effective(const MaterialSample& s) {
  return 3 * (s.history(zeta) - s.pressure());
}
// X_d = p0 + p1 (phi_0/phi - 1)^(1/p2), as the manuals have it.
double crush(double p0, double e) {
  if (e >= 0) return p0;
  const double phi = 1 - 0.6 * std::exp(-e);
  return p0 + 482.68e6 * std::pow(0.4 / phi - 1, 1 / 0.719);
}
// F_f F_c of the numbers above.
double strength(const Given& g, double I, double e) {
  const double a2 = (g.FSLOPE - g.YSLOPE) / (g.STREN - g.YSLOPE * g.PEAKI1);
  const double a3 = (g.STREN - g.YSLOPE * g.PEAKI1) * std::exp(-a2 * g.PEAKI1);
  const double F = g.STREN - a3 * std::exp(a2 * I) - g.YSLOPE * I;
  const double X = -crush(g.p0, e), kappa = g.PEAKI1 - 0.5 * (g.PEAKI1 - X);
  if (I >= kappa) return F;
  const double t = (kappa - I) / (kappa - X);
  return F * std::sqrt(std::max(1 - t * t, 0.0));
}

// Pressed in all directions: the stress of the grains stays on the crush curve, whatever the water.
TEST(ArenaSoil, IsCrushedAlongItsCurve) {
  for (const double S : {0.0, 0.3, 1.0}) {
    Given g;
    g.S = S;
    MaterialSample s = sample(g);
    double worst = 0;
    follow(
        s,
        [](double t) {
          const double l = std::exp(-0.08 * t);
          return diagonal(l, l, l);
        },
        1, 800,
        [&](const MaterialSample& now) {
          if (now.time() > 0.5)
            worst = std::max(worst, std::abs(-effective(now) / crush(1e6, now.history(e_v)) - 1));
        });
    EXPECT_LT(s.history(e_v), -0.02) << S;
    EXPECT_LT(worst, 1e-9) << S;
    EXPECT_NEAR(s.history(e_e), -0.24 - s.history(e_v), 1e-12);
    EXPECT_NEAR(s.history(cap), -crush(1e6, s.history(e_v)) - 3 * s.history(zeta), 1);
  }
}

// Dry soil below its first crushing: int dp/K_d = the change of volume, by Simpson's rule.
TEST(ArenaSoil, IsElasticBelowTheCap) {
  Given g;
  g.p0 = 1e9;
  MaterialSample s = sample(g);
  follow(
      s,
      [](double t) {
        const double l = std::exp(-0.05 * t);
        return diagonal(l, l, l);
      },
      1, 200);
  EXPECT_EQ(s.history(e_v), 0);
  WetSoil soil;
  soil.phi_0 = 0.4;
  soil.b0 = 0.0029;
  soil.b1 = 0.4731;
  soil.b2 = 1.5057;
  soil.b3 = 2.5728;
  soil.b4 = 2.0799;
  const double p = s.pressure();
  // p = q^2: 1/K_d is steep at 0.
  const int n = 4000;
  double strain = 0;
  for (int k = 0; k <= n; ++k) {
    const double q = std::sqrt(p) * k / n, weight = k == 0 || k == n ? 1 : k % 2 == 1 ? 4 : 2;
    strain += weight * 2 * q / soil.drained_modulus(q * q);
  }
  strain *= std::sqrt(p) / n / 3;
  EXPECT_NEAR(strain, 0.15, 1e-5);
  // And back: no trace is left.
  follow(
      s,
      [](double t) {
        const double l = std::exp(-0.05 * (2 - t));
        return diagonal(l, l, l);
      },
      2, 200);
  EXPECT_NEAR(s.pressure(), 0, 1e-5 * p);
}

// Uniaxial strain to and fro, and a shear: on or in the surface after each step.
TEST(ArenaSoil, StaysOnItsSurface) {
  for (const double beta : {1.0, 0.6, 1.7}) {
    Given g;
    g.beta = beta;
    MaterialSample s = sample(g);
    int on = 0;
    follow(
        s,
        [](double t) {
          return Matrix{1 - 0.06 * std::sin(3 * t), 0.03 * t, 0, 0, 1 - 0.01 * t, 0, 0, 0, 1};
        },
        2, 200,
        [&](const MaterialSample& now) {
          const double I = effective(now), q = root_J2(now);
          EXPECT_LE(I, g.PEAKI1 * (1 + 1e-9));
          const double limit = strength(g, I, now.history(e_v));
          EXPECT_LE(q, limit + 1e-6 * 1e7) << now.time();
          on += std::abs(q - limit) < 1e-6 * 1e7;
        });
    EXPECT_GT(on, 100);
  }
}

// Associated flow in a convex domain around 0: no step gives work away.
TEST(ArenaSoil, PlasticFlowCostsWork) {
  for (const double S : {0.0, 0.5}) {
    Given g;
    g.S = S;
    MaterialSample s = sample(g);
    double volume = 0, shear = 0, least = 0, all = 0;
    follow(
        s,
        [](double t) {
          const double w = 6.283185307179586 * t;
          return Matrix{1 - 0.03 * (1 - std::cos(w)),
                        0.02 * std::sin(w),
                        0,
                        0.01 * std::sin(2 * w),
                        1 - 0.02 * std::sin(w),
                        0,
                        0,
                        0,
                        1 + 0.01 * std::sin(w)};
        },
        2, 800,
        [&](const MaterialSample& now) {
          const double work = effective(now) / 3 * (now.history(e_v) - volume) +
                              std::sqrt(3.0) * root_J2(now) * (now.history(e_q) - shear);
          volume = now.history(e_v);
          shear = now.history(e_q);
          least = std::min(least, work);
          all += work;
        });
    EXPECT_GT(all, 1e4) << S;
    EXPECT_GE(least, -1e-9 * all) << S;
  }
}

// Through yield, crushing and unloading: errors fall with the square of the step.
TEST(ArenaSoil, IsOfSecondOrderInTheStep) {
  const auto stress = [](double S, int steps) {
    Given g;
    g.S = S;
    MaterialSample s = sample(g);
    follow(
        s,
        [](double t) {
          return Matrix{1 - 0.06 * std::sin(1.9 * t), 0.02 * t, 0, 0, 1 - 0.01 * t, 0, 0, 0, 1};
        },
        1, steps);
    return s.stress();
  };
  for (const double S : {0.0, 0.3}) {
    const auto fine = stress(S, 3200), a = stress(S, 100), b = stress(S, 200);
    double of_a = 0, of_b = 0, size = 0;
    for (std::size_t k = 0; k < 6; ++k) {
      of_a = std::max(of_a, std::abs(a[k] - fine[k]));
      of_b = std::max(of_b, std::abs(b[k] - fine[k]));
      size = std::max(size, std::abs(fine[k]));
    }
    EXPECT_LT(of_a, 2e-2 * size) << S;
    EXPECT_LT(of_b, 0.45 * of_a) << S;
  }
}

// Fluid and body begin at one pressure, and grains bear nothing.
TEST(ArenaSoil, BeginsAtThePressureOfItsPores) {
  Given g;
  g.S = 0.5;
  g.pressure = 3e5;
  const MaterialSample s = sample(g);
  EXPECT_NEAR(s.pressure(), 3e5, 1e-4);
  EXPECT_NEAR(effective(s), 0, 1e-4);
}

// In uniaxial strain at a steady rate the stress is ahead of a flat surface by 2 G e_dot' tau,
// tau = T1 |D|^-T2; held, it sinks to it (tau does not count without a rate).
TEST(ArenaSoil, TrailsItsRestStress) {
  Given g;
  g.p0 = 1e12;
  g.nu = 0;
  g.PEAKI1 = 1e10;
  g.FSLOPE = g.YSLOPE = 0;
  g.STREN = 1e6;
  g.T1 = 0.01;
  g.T2 = 0.5;
  MaterialSample s = sample(g);
  follow(
      s, [](double t) { return diagonal(std::exp(-0.25 * t), 1, 1); }, 1, 200);
  const double tau = 0.01 / std::sqrt(0.25);
  const double ahead = 2 * 7e8 * std::sqrt(2.0 / 3) * 0.25 * tau / std::sqrt(2.0);
  EXPECT_NEAR(root_J2(s), 1e6 + ahead, 1e-3 * ahead);
  double quiet_J2 = 0;
  for (int k = 0; k < 3; ++k) quiet_J2 += std::pow(s.history(quiet + k) - s.history(quiet), 2);
  EXPECT_NEAR(std::sqrt(quiet_J2 / 6), 1e6, 1);  // sqrt(J2) of (a, b, b): |b - a|/sqrt(3)
  // Steps far longer than tau leave nothing of it.
  follow(
      s, [](double t) { return diagonal(std::exp(-0.25 * t), 1, 1); }, 101, 1);
  for (int k = 0; k < 6; ++k)
    EXPECT_NEAR(s.stress()[k], s.history(quiet + k), 1e-3 * std::abs(s.history(quiet)));
}

// Sheared far beyond yield nearly all strain is plastic: the time of flow is the time since yield.
TEST(ArenaSoil, LosesCoherenceWithTheTimeOfFlow) {
  Given g;
  g.p0 = 1e12;
  g.nu = 0;
  g.PEAKI1 = 1e10;
  g.FSLOPE = g.YSLOPE = 0;
  g.STREN = 1e6;
  g.more = "<do_damage>true</do_damage><fspeed>6</fspeed><time_at_failure>.5</time_at_failure>";
  std::string text = text_of(g);
  text.replace(text.find("</plastic"), 0, "<YSLOPE_failed>0</YSLOPE_failed>");
  MaterialSample s(law("ArenaSoil", text, soil_constants()), soil_constants(), 1, 298);
  double most = 1;
  follow(
      s, [](double t) { return Matrix{1, t, 0, 0, 1, 0, 0, 0, 1}; }, 1, 1000,
      [&](const MaterialSample& now) {
        EXPECT_LE(now.history(coherence), most);
        most = now.history(coherence);
        const double x = 6 * (now.history(grown) / 0.5 - 1);
        const double C = now.history(grown) > 0 ? 1 / (1 + std::exp(x)) : 1;
        EXPECT_NEAR(now.history(coherence), C, 1e-12);
      });
  EXPECT_NEAR(s.history(grown), 1, 0.01);
  const double C = s.history(coherence);
  EXPECT_LT(C, 0.01);
  EXPECT_NEAR(s.history(stren), 1e6 * (C + 0.1 * (1 - C)), 1);
  EXPECT_NEAR(root_J2(s), s.history(stren), 2e-3 * 1e6);
  const double c = s.wave_speed();  // K and G lose as much
  EXPECT_NEAR(c * c * 1500 / (0.0029 * 40e9 + 4.0 / 3 * 7e8) / C, 1, 0.05);
}

// Full of water, pressed to an eighth of its volume: grains and water bear what pores cannot.
TEST(ArenaSoil, BearsWhatPoresCannot) {
  Given g;
  g.S = 1;
  g.p0 = 1000;
  g.nu = 0;
  g.more = "<yield_surface_radius_scaling_factor>1000</yield_surface_radius_scaling_factor>";
  MaterialSample s = sample(g);
  double before = -1;
  follow(
      s, [](double t) { return diagonal(1 - 0.5 * t, 1 - 0.5 * t, 1 - 0.5 * t); }, 1, 1000,
      [&](const MaterialSample& now) {
        EXPECT_GT(now.pressure(), before);
        before = now.pressure();
        EXPECT_EQ(now.history(saturation), 1);
      });
  EXPECT_GT(s.history(share), 0);
  EXPECT_LT(-s.history(e_v), 0.5108256);
  EXPECT_TRUE(std::isfinite(s.pressure()));
}

TEST(ArenaSoil, SaysWhereItsModuliEnd) {
  Given g;
  std::string text = text_of(g);
  text.replace(text.find("<b1>.4731"), 9, "<b1>.1000");
  MaterialSample s(law("ArenaSoil", text, soil_constants()), soil_constants(), 1, 298);
  std::optional<BatchFault> fault;
  for (int n = 1; n <= 200 && !fault; ++n) {
    const double l = 1 - 0.0049 * n;
    fault = s.step(diagonal(l, l, l), 1e-3);
  }
  ASSERT_TRUE(fault);
  EXPECT_NE(std::string(fault->reason).find("beyond the range of the moduli"), std::string::npos);
}

TEST(ArenaSoil, TellsWhatItIsNot) {
  const auto told_of = [](const std::string& from, const std::string& to) {
    std::vector<Fault> faults;
    Given g;
    g.S = 0.6;
    std::string text = text_of(g);
    text.replace(text.find(from), from.size(), to);
    law_of_text("ArenaSoil", text, soil_constants(), faults);
    return told(faults);
  };
  const auto expect = [&](const std::string& from, const std::string& to, const char* says) {
    const std::string text = told_of(from, to);
    EXPECT_NE(text.find(says), std::string::npos) << to << ": " << text;
  };
  const std::string end = "<p1_sat>1</p1_sat>";
  expect(end, end + "<use_disaggregation_algorithm>true</use_disaggregation_algorithm>",
         "<use_disaggregation_algorithm> is known to the format, but not supported");
  expect(end, end + "<reference_porosity>.42</reference_porosity>",
         "<reference_porosity> is known");
  expect(end, end + "<p1_density_scale_fac>1</p1_density_scale_fac>", "<p1_density_scale_fac> is");
  expect(end, end + "<eq_plastic_strain_at_failure>1</eq_plastic_strain_at_failure>",
         "<eq_plastic_strain_at_failure> is known");
  expect("<CR>", "<weibullDist_STREN>weibull,1,2,3,4</weibullDist_STREN><CR>",
         "<weibullDist_STREN> is known");
  expect(end, "<p1_sat>-1</p1_sat>", "crushed pores would not harden");
  expect("<p3>.5108256</p3>", "<p3>.448</p3>", "<p3> has no effect: -ln(1 - initial_porosity)");
  expect("<p0>1000000</p0>", "<p0>10</p0>", "<p0> is less than 1000 Pa");
  expect("<T1>0</T1>", "<T1>1</T1>", "<T1> and <T2> must both be above 0");
  expect("<FSLOPE>0.453", "<FSLOPE>0.2", "limit curve");
  expect("type='arena'><b0>", "type='tabular'><b0>", "<elastic_moduli_model type>");
  expect("<b0>.0029</b0>", "", "needs <b0>");
}

}  // namespace
}  // namespace sluice::mpm::arena
