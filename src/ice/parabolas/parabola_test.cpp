// Parabolas in a cell: exact where they must be, within their neighbours where flow is not smooth.
#include "ice/parabolas/parabola.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>

namespace sluice::ice::parabola_test {
namespace {

using Means = std::array<double, 5>;

Parabola of(const Means& q) {
  return parabola(q[1] - q[0], q[2] - q[1], q[3] - q[2], q[4] - q[3]);
}

// Mean of a polynomial over [a, b], from the coefficients.
double mean(const std::array<double, 4>& c, double a, double b) {
  double sum = 0;
  for (int n = 0; n < 4; ++n)
    sum += c[n] / (n + 1) * (std::pow(b, n + 1) - std::pow(a, n + 1)) / (b - a);
  return sum;
}
Means means(const std::array<double, 4>& c) {
  Means q;
  for (int i = 0; i < 5; ++i) q[i] = mean(c, i - 2.5, i - 1.5);
  return q;
}

TEST(Parabola, IsExactForQuadratics) {
  for (const double bend : {-0.8, 0.0, 0.3, 2.0})
    for (const double rise : {-3.0, 0.0, 0.4}) {
      const std::array<double, 4> c{1.5, rise, bend, 0};
      const Parabola a = of(means(c));
      const double middle = mean(c, -0.5, 0.5);
      EXPECT_NEAR(middle - a.low, 1.5 - 0.5 * rise + 0.25 * bend, 1e-14);
      EXPECT_NEAR(middle + a.high, 1.5 + 0.5 * rise + 0.25 * bend, 1e-14);
      for (const double s : {0.0, 0.1, 0.5, 0.8, 1.0}) {
        if (s == 0) continue;
        EXPECT_NEAR(mean_at_high_edge(a.low, a.high, s), mean(c, 0.5 - s, 0.5) - middle, 2e-14);
        EXPECT_NEAR(mean_at_low_edge(a.low, a.high, s), mean(c, -0.5, -0.5 + s) - middle, 2e-14);
      }
    }
}

// Edges of fourth order: those of a cubic, where it is smooth or monotone.
TEST(Parabola, HasTheEdgesOfCubics) {
  const std::array<double, 4> c{0, 4, 0.5, 0.2};
  const Parabola a = of(means(c));
  const double middle = mean(c, -0.5, 0.5);
  EXPECT_NEAR(middle - a.low, -2 + 0.125 - 0.025, 1e-14);
  EXPECT_NEAR(middle + a.high, 2 + 0.125 + 0.025, 1e-14);
}

TEST(Parabola, KeepsSmoothExtremaAndLimitsSharpOnes) {
  const auto wave = [](double cells) {
    Means q;
    const double k = 2 * std::numbers::pi / cells;
    for (int i = 0; i < 5; ++i)
      q[i] = (std::sin(k * (i - 1.5)) - std::sin(k * (i - 2.5))) / k;  // of cos, crest at 0
    return q;
  };
  const Parabola smooth = of(wave(12)), sharp = of(wave(4));
  EXPECT_GT(smooth.low, 0.0);
  EXPECT_LT(smooth.high, 0.0);
  EXPECT_EQ(sharp.low, 0.0);
  EXPECT_EQ(sharp.high, 0.0);
  const Parabola peak = of({0, 0, 1, 0, 0});
  EXPECT_EQ(peak.low, 0.0);
  EXPECT_EQ(peak.high, 0.0);
}

// Whatever the share, means lie between those of the neighbours.
TEST(Parabola, StaysBetweenItsNeighboursAtJumps) {
  std::mt19937 numbers(7);
  std::uniform_real_distribution<double> any(-1, 1);
  for (int n = 0; n < 20000; ++n) {
    Means q;
    for (double& x : q) x = any(numbers);
    const double em = q[0] - 2 * q[1] + q[2], e0 = q[1] - 2 * q[2] + q[3],
                 ep = q[2] - 2 * q[3] + q[4];
    if (em * e0 > 0 && e0 * ep > 0) continue;  // may be smooth
    const Parabola a = of(q);
    for (const double s : {0.0, 0.3, 0.7, 1.0})
      for (const double at :
           {mean_at_high_edge(a.low, a.high, s), mean_at_low_edge(a.low, a.high, s)}) {
        EXPECT_LE(q[2] + at, std::fmax(q[2], std::fmax(q[1], q[3])) + 1e-15);
        EXPECT_GE(q[2] + at, std::fmin(q[2], std::fmin(q[1], q[3])) - 1e-15);
      }
  }
}

TEST(Parabola, IsItsOwnMirrorImageToTheBit) {
  std::mt19937 numbers(3);
  std::uniform_real_distribution<double> any(-1, 1);
  for (int n = 0; n < 20000; ++n) {
    Means q, turned, negative;
    for (int i = 0; i < 5; ++i) q[i] = any(numbers) * (n % 3 == 0 ? 0.01 * i * i : 1.0);
    for (int i = 0; i < 5; ++i) {
      turned[i] = q[4 - i];
      negative[i] = -q[i];
    }
    const Parabola a = of(q), b = of(turned), c = of(negative);
    EXPECT_EQ(a.low, -b.high);
    EXPECT_EQ(a.high, -b.low);
    EXPECT_EQ(a.low, -c.low);
    EXPECT_EQ(a.high, -c.high);
    EXPECT_EQ(mean_at_high_edge(a.low, a.high, 0.3), mean_at_low_edge(b.low, b.high, 0.3));
  }
}

}  // namespace
}  // namespace sluice::ice::parabola_test
