// Moduli, pores and crush curve of soil against limits and numbers found without this code.
#include "mpm/material/geologic/wet_soil.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace sluice::mpm::wet_soil {
namespace {

WetSoil sand(double saturation) {
  WetSoil s;
  s.phi_0 = 0.4;
  s.S_0 = saturation;
  s.p0 = 1e6;
  s.p1 = 482.68e6;
  s.p2 = 0.719;
  s.b0 = 0.0029;
  s.b1 = 0.4731;
  s.b2 = 1.5057;
  s.b3 = 2.5728;
  s.b4 = 2.0799;
  s.G0 = 7e8;
  s.nu1 = 0.35;
  return s;
}

TEST(WetSoil, BeginsAsTheDeckSays) {
  for (const double S : {0.0, 0.3, 1.0}) {
    WetSoil s = sand(S);
    s.pressure_0 = 2e5;
    const WetSoil::Pores pores = s.pores(0);
    EXPECT_NEAR(pores.pressure, 2e5, 1e-5);  // round-off of 1 over the softest phase
    EXPECT_NEAR(pores.share, 0.4, 1e-14);
    EXPECT_NEAR(pores.saturation, S, 1e-14);
    EXPECT_EQ(s.crush(0), 1e6);
  }
}

// Numbers of a root search of its own, with constant moduli of water and grains, S_0 = 1/2.
TEST(WetSoil, PoresHaveThePressureOfTheirClosedForm) {
  WetSoil s = sand(0.5);
  s.grains.n = s.water.n = 0;
  struct {
    double e, zeta, S_w, phi;
  } const rows[] = {{0.05, 48521.7, 0.56941, 0.36924},
                    {0.1, 148908, 0.65604, 0.33690},
                    {0.2, 2.63168e6, 0.91311, 0.26721}};
  for (const auto& row : rows) {
    const WetSoil::Pores pores = s.pores(-row.e);
    EXPECT_NEAR(pores.pressure / row.zeta, 1, 2e-6);
    EXPECT_NEAR(pores.saturation, row.S_w, 5e-6);
    EXPECT_NEAR(pores.share, row.phi, 5e-6);
  }
}

// The rate form of the manuals: d zeta/d(-e) = exp(e)/B,
// B = sum of (share of a phase) (its volume ratio)/(its modulus).
TEST(WetSoil, PressureRisesByTheRateForm) {
  for (const double S : {0.0, 0.5, 0.9, 1.0})
    for (const double e : {-0.02, -0.1, -0.3}) {
      const WetSoil s = sand(S);
      const double h = 1e-6;
      const double slope = (s.pore_pressure(e - h) - s.pore_pressure(e + h)) / (2 * h);
      const double zeta = s.pore_pressure(e);
      const double B = 0.4 * (1 - S) * s.air.volume_ratio(zeta, 0) / s.air.modulus(zeta) +
                       0.4 * S * s.water.volume_ratio(zeta, 0) / s.water.modulus(zeta) +
                       0.6 * s.grains.volume_ratio(zeta, 0) / s.grains.modulus(zeta);
      EXPECT_NEAR(slope * B / std::exp(e), 1, 1e-5) << S << ' ' << e;
    }
}

// With grains that give way little against air, phi = 1 - (1 - phi_0) exp(-e), and air is squeezed
// by (1 + zeta/p_r)^(-1/1.4).
TEST(WetSoil, DryPoresHoldAir) {
  const WetSoil s = sand(0);
  const WetSoil::Pores pores = s.pores(-0.2);
  EXPECT_NEAR(pores.share, 1 - 0.6 * std::exp(0.2), 1e-4);
  const double squeezed = (std::exp(-0.2) - 0.6) / 0.4;
  EXPECT_NEAR(pores.pressure / (101325 * (std::pow(squeezed, -1.4) - 1)), 1, 1e-4);
  EXPECT_EQ(pores.saturation, 0);
}

TEST(WetSoil, PoresThatOpenBearNothing) {
  const WetSoil s = sand(0.5);
  EXPECT_EQ(s.pore_pressure(0.1), 0);
  EXPECT_GT(s.pores(0.1).share, 0.4);
}

TEST(WetSoil, WithoutPressureModuliAreThoseAtRest) {
  for (const double S : {0.0, 1.0})
    for (const double I : {0.0, 1e5}) {
      const WetSoil s = sand(S);
      const WetSoil::Moduli m = s.moduli(I, s.pores(0));
      EXPECT_DOUBLE_EQ(m.K, 0.0029 * 40e9);
      EXPECT_DOUBLE_EQ(m.G, 1.5 * m.K * 0.3 / 1.35);
    }
  WetSoil constant = sand(0);
  constant.nu1 = 0;
  EXPECT_EQ(constant.moduli(-1e8, constant.pores(0)).G, 7e8);
}

// K_d is the slope of p = K_s(p) (b0 x + b1 x^b4/(b2 x^b4 + b3)); the strain at which it is taken
// leaves the term of b0 out.
TEST(WetSoil, DrainedModulusIsTheSlopeOfItsCurve) {
  const WetSoil s = sand(0);
  const auto curve = [&](double x) {
    const double y = std::pow(x, s.b4), f = s.b0 * x + s.b1 * y / (s.b2 * y + s.b3);
    return s.grains.K0 * f / (1 - s.grains.n * f);  // of p = (K_0 + n p) f
  };
  for (const double x : {0.01, 0.1, 0.4}) {
    const double slope = (curve(x + 1e-6) - curve(x - 1e-6)) / 2e-6;
    const double y = std::pow(x, s.b4), f = s.b1 * y / (s.b2 * y + s.b3);
    const double p = s.grains.K0 * f / (1 - s.grains.n * f);  // where x is that strain
    // K_s^2/K_0 of both pressures differ by the term of b0.
    const double outer = (s.grains.modulus(curve(x)) / s.grains.modulus(p));
    EXPECT_NEAR(s.drained_modulus(p) * outer * outer / slope, 1, 1e-6) << x;
  }
  EXPECT_NEAR(s.drained_modulus(1e-3) / (0.0029 * 40e9), 1, 1e-4);
}

// Pores full of a fluid as stiff as the grains make no difference: K = K_s. Full of nearly nothing:
// K = K_d.
TEST(WetSoil, BetweenDrainedAndAllGrains) {
  WetSoil s = sand(1);
  s.water = s.grains;
  const double p = 5e7;
  WetSoil::Pores pores = s.pores(0);
  pores.pressure = p;
  EXPECT_NEAR(s.moduli(-3 * p, pores).K / s.grains.modulus(p), 1, 1e-12);
  s.water = {1e-3, 0};
  EXPECT_NEAR(s.moduli(-3 * p, pores).K / s.drained_modulus(p), 1, 1e-9);
  // Biot and Gassmann between them, in the form of Gassmann 1951:
  //   K/(K_s - K) = K_d/(K_s - K_d) + K_f/(phi (K_s - K_f))
  s.water = {2.21e9, 0};
  const double K = s.moduli(-3 * p, pores).K, K_s = s.grains.modulus(p), K_d = s.drained_modulus(p);
  EXPECT_NEAR(K / (K_s - K), K_d / (K_s - K_d) + 2.21e9 / (0.4 * (K_s - 2.21e9)), 1e-12);
}

// X_d: p0 without compaction, 2 p1 more where phi_0/phi - 1 = 2^p2, steep where no pore is left.
TEST(WetSoil, CrushCurve) {
  const WetSoil s = sand(0);
  EXPECT_EQ(s.crush(0.1), 1e6);
  const double phi = 0.4 / (1 + std::pow(2, 0.719)), e = std::log((1 - 0.4) / (1 - phi));
  EXPECT_NEAR(s.crush(e) / (1e6 + 2 * 482.68e6), 1, 1e-12);
  EXPECT_NEAR(s.p3(), 0.510826, 1e-6);
  EXPECT_GT(s.crush(-s.p3()), 1e15);
  WetSoil wet = sand(0.5);
  wet.p1_sat = 0.2;
  EXPECT_NEAR(wet.strength(e), 1e6 + 0.6 * (s.crush(e) - 1e6), 1);
  wet.p1_sat = 1;
  EXPECT_NEAR(wet.strength(e), s.crush(e), 1);
}

}  // namespace
}  // namespace sluice::mpm::wet_soil
