// Exchange against the exponential, in both limits, and in what it keeps.
#include "ice/closure/pair_relaxation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include "ice/test_support/exchange.hpp"

namespace sluice::ice::mixture::pair_relaxation_test {
namespace {

double coefficient(double k, std::size_t i, std::size_t j) {
  return k * (1 + .3 * static_cast<double>(i + j));
}

// Values after `steps` steps of the whole time 1.
Numbers relaxed(Numbers v, const Numbers& C, double k, int steps) {
  const std::size_t n = C.size();
  for (int s = 0; s < steps; ++s) {
    Numbers rates(n * n, 0.0), gain(n);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j)
        if (i != j) rates[i * n + j] = coefficient(k, i, j) / steps;
    relax_pairs(static_cast<int>(n), C.data(), v.data(), rates.data(), gain.data());
    for (std::size_t m = 0; m < n; ++m) v[m] += gain[m] / C[m];
  }
  return v;
}

// By the exponential.
Numbers exact(const Numbers& v, const Numbers& C, double k) {
  Matrix rates(C.size(), Numbers(C.size(), 0.0));
  for (std::size_t i = 0; i < C.size(); ++i)
    for (std::size_t j = 0; j < C.size(); ++j) rates[i][j] = coefficient(k, i, j);
  return exchanged(C, rates, v);
}

double mean(const Numbers& v, const Numbers& C) {
  double sum = 0, total = 0;
  for (std::size_t m = 0; m < C.size(); ++m) {
    sum += C[m] * v[m];
    total += C[m];
  }
  return sum / total;
}

TEST(PairRelaxation, OfTwoIsTheExponential) {
  const Numbers C = {2, 5}, v = {400, 300};
  const double k = .7;
  const Numbers after = relaxed(v, C, k, 1);
  EXPECT_NEAR(after[0] - after[1], 100 * std::exp(-1.3 * k * (1 / 2. + 1 / 5.)), 1e-12 * 100);
  EXPECT_NEAR(mean(after, C), mean(v, C), 1e-13 * 400);
  EXPECT_LE(farthest(after, exact(v, C, k)), 1e-13 * 400);
}

TEST(PairRelaxation, OfFiveIsOfSecondOrder) {
  constexpr double min_order = 1.9;
  const Numbers C = {2, 5, .1, 30, 1}, v = {400, 300, 1000, 290, 20};
  for (const double k : {1e-3, .05, .5}) {
    const auto error = [&](int steps) { return farthest(relaxed(v, C, k, steps), exact(v, C, k)); };
    EXPECT_GE(std::log2(error(64) / error(128)), min_order) << k;
  }
}

TEST(PairRelaxation, BothLimitsAreExact) {
  for (const Numbers& C : {Numbers{2, 5}, Numbers{2, 5, 1e-12, 3e4, 1}}) {
    Numbers v = {400, 300, 1000, 290, 20};
    v.resize(C.size());
    const Numbers still = relaxed(v, C, 0, 1);
    for (std::size_t m = 0; m < C.size(); ++m) EXPECT_DOUBLE_EQ(still[m], v[m]);
    for (const double k : {1e15, 1e20}) {
      const Numbers one = relaxed(v, C, k, 1);
      for (std::size_t m = 0; m < C.size(); ++m)
        EXPECT_NEAR(one[m], mean(v, C), 1e-12 * 400) << m << " of " << C.size();
    }
  }
}

TEST(PairRelaxation, GainsSumToZeroForAnyCoefficient) {
  const Numbers C = {2, 5, 1e-8, 3e4, 1}, v = {400, 300, 1000, 290, 20};
  for (double k = 1e-10; k < 1e21; k *= 1e3) {
    Numbers rates(25, k), gain(5);
    for (std::size_t i = 0; i < 5; ++i) rates[i * 6] = 0;
    relax_pairs(5, C.data(), v.data(), rates.data(), gain.data());
    double sum = 0, size = 0;
    for (const double g : gain) {
      sum += g;
      size += std::fabs(g);
    }
    EXPECT_LE(std::fabs(sum), 1e-15 * size) << k;
  }
}

}  // namespace
}  // namespace sluice::ice::mixture::pair_relaxation_test
