// Limit curve, cap and pores: published shapes, nearest points against a search of the whole curve,
// and identities of the mixture in the pores.
#include "mpm/material/geologic/cap_surface.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "mpm/material/geologic/porous_rock.hpp"

namespace sluice::mpm::rock {
namespace {

CapSurface surface_of(double STREN, double YSLOPE, double CR) {
  CapSurface s{*limit_curve(600, 0.3, STREN, YSLOPE), -2000, 0};
  s.kappa = s.limit.peak - CR * (s.limit.peak - s.X);
  return s;
}

TEST(LimitCurve, HasItsFourShapes) {
  const LimitCurve linear = *limit_curve(600, 0.3, 0, 0);
  EXPECT_EQ(linear.a1, 180);
  EXPECT_EQ(linear.a4, 0.3);
  const LimitCurve level = *limit_curve(600, 0, 50, 0);
  EXPECT_EQ(level.a1, 50);
  // The curve begins at PEAKI1 with FSLOPE and ends with STREN - YSLOPE I.
  for (const double YSLOPE : {0.0, 0.1}) {
    const CapSurface s{*limit_curve(600, 0.3, 300, YSLOPE), -1e9, -1e8};
    EXPECT_NEAR(s.strength(600), 0, 1e-12 * 300);
    EXPECT_NEAR(s.slope(600), -0.3, 1e-12);
    EXPECT_NEAR(s.strength(-1e5), 300 + YSLOPE * 1e5, 1e-9);
  }
  EXPECT_FALSE(limit_curve(600, 0.1, 300, 0.2));  // the curve would not be concave
  EXPECT_FALSE(limit_curve(600, 0.3, 30, 0.2));   // STREN < YSLOPE PEAKI1
  EXPECT_FALSE(limit_curve(600, 0, 0, 0));
}

TEST(CapSurface, SlopeIsTheDerivative) {
  const CapSurface s = surface_of(400, 0.05, 0.6);
  for (const double I : {-1990.0, -1500.0, -1000.0, 0.0, 500.0}) {
    const double h = 1e-3;
    EXPECT_NEAR(s.slope(I), (s.strength(I + h) - s.strength(I - h)) / (2 * h), 1e-6) << I;
  }
}

// Against the least distance of 2e5 points of the curve.
TEST(CapSurface, NearestPointIsTheNearestOfTheCurve) {
  std::mt19937 random(7);
  const auto number = [&](double low, double high) {
    return low + (high - low) * (static_cast<double>(random()) / 4294967296.0);
  };
  for (const CapSurface& s : {surface_of(0, 0, 0.5), surface_of(400, 0, 0.3),
                              surface_of(400, 0.1, 0.9), surface_of(0, 0, 1)}) {
    for (int n = 0; n < 60; ++n) {
      const Meridian trial{number(-4000, 2000), number(0, 2500)};
      if (s.contains(trial)) continue;
      const double scale = number(0.3, 3);
      const auto distance = [&](const Meridian& m) {
        return std::hypot((m.I - trial.I) / std::sqrt(3), std::sqrt(2) * scale * (m.q - trial.q));
      };
      double least = 1e99;
      const int points = 20000;
      for (int k = 0; k <= points; ++k) {
        const double I = s.X + (s.limit.peak - s.X) * k / points;
        least = std::min(least, distance({I, std::min(s.strength(I), trial.q)}));
      }
      const Meridian found = s.nearest(trial, scale);
      EXPECT_LE(distance(found), least * (1 + 1e-12)) << trial.I << " " << trial.q;
      EXPECT_GE(found.I, s.X);
      EXPECT_LE(found.I, s.limit.peak);
      EXPECT_LE(found.q, s.strength(found.I) * (1 + 1e-12));
    }
  }
}

PorousRock sandstone() {
  PorousRock r;
  r.B0 = 6e9;
  r.B1 = 20e9;
  r.B2 = 1e8;
  r.p0 = -3e7;
  r.p1 = 5e-9;
  r.p3 = 0.2;
  return r;
}

// Gassmann: a fluid as stiff as the matrix makes the body as stiff, however many pores it has; one
// without stiffness leaves it dry.
TEST(PorousRock, FluidHasItsLimits) {
  PorousRock r = sandstone();
  const double I = -3e8, e = -0.05, dry = r.modulus(I, e);
  EXPECT_NEAR(dry, 6e9 + 20e9 * std::exp(-1.0 / 3), 1);
  r.fluid = 26e9;
  EXPECT_NEAR(r.modulus(I, e) / 26e9, 1, 1e-12);
  r.fluid = 1;
  EXPECT_NEAR(r.modulus(I, e) / dry, 1, 1e-6);
  r.fluid = 2.2e9;
  EXPECT_GT(r.modulus(I, e), dry);
  EXPECT_LT(r.modulus(I, e), 26e9);
}

TEST(PorousRock, PoresCrushWithoutEnd) {
  const PorousRock r = sandstone();
  EXPECT_NEAR(r.porosity(0), 1 - std::exp(-0.2), 1e-15);
  EXPECT_EQ(r.porosity(-0.2), 0);
  EXPECT_EQ(r.crush(0), r.p0);
  EXPECT_NEAR(r.crush(-0.1), -3e7 + std::log(0.5) / 5e-9, 1e-6 * 3e7);
  EXPECT_LT(r.crush(-0.21), 1e11 * r.p0);
  const double h = 1e-7;  // one slope on both sides of the start
  EXPECT_NEAR((r.crush(h) - r.crush(0)) / (r.crush(0) - r.crush(-h)), 1, 1e-5);
}

// The frame of moduli K and 1/K_R: the pressure of the fluid against its differential equation.
TEST(PorousRock, FluidBearsWhatTheFrameDoesNot) {
  PorousRock r = sandstone();
  r.fluid = 2.2e9;
  r.fluid_pressure = 1e6;
  EXPECT_NEAR(r.back_stress(0), -3e6, 1e-6);
  for (const double e : {-0.15, -0.1, -1e-3}) {
    const double h = 1e-6, phi = r.porosity(e);
    const double slope = (r.back_stress(e + h) - r.back_stress(e - h)) / (2 * h) / -3;
    const double reuss = phi / 2.2e9 + (1 - phi) / 26e9;
    EXPECT_NEAR(-1 / slope / (reuss - 1 / r.modulus(0, e)), 1, 1e-6) << e;
  }
  EXPECT_LT(r.back_stress(-0.2), -1e15);  // no pore is left
  EXPECT_EQ(r.back_stress(0.1), 0);       // a fluid bears no tension
}

}  // namespace
}  // namespace sluice::mpm::rock
