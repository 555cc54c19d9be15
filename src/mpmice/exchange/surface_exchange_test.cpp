// What passes pairs of cells in a step: any network of them, any coefficients.
#include "mpmice/exchange/exchange_terms.hpp"

#include <gtest/gtest.h>

#include <random>

namespace sluice::mpmice::surface_exchange_test {
namespace {

// One pair: Q = (T_g - T_s)/(1/(dt G) + 1/C_g + 1/C_s), both limits too.
TEST(PairsOfCells, OneIsTheImplicitExchange) {
  const double dt = 1e-3, C_g = 3, C_s = 40;
  for (const double G : {1e-12, 1.0, 1e5, 1e300}) {
    const double expected = 1 / (1 / (dt * G) + 1 / C_g + 1 / C_s);
    EXPECT_NEAR(passes(G, dt, G, 1 / C_g, G, 1 / C_s) / expected, 1, 1e-15) << G;
  }
  EXPECT_NEAR(passes(1e300, dt, 1e300, 1 / C_g, 1e300, 0) / C_g, 1, 1e-15);
}

// Cells in front and behind, joined at random: no value leaves the range, the sum stays.
TEST(PairsOfCells, NoneOfManyPassesTheOtherSide) {
  std::mt19937 random(5);
  const auto power = [&](double low, double high) {
    return std::pow(10.0, std::uniform_real_distribution<double>(low, high)(random));
  };
  constexpr std::size_t n = 6;
  for (int trial = 0; trial < 300; ++trial) {
    double G[n][n], C_g[n], C_s[n], S_g[n] = {}, S_s[n] = {};
    for (std::size_t g = 0; g < n; ++g) {
      C_g[g] = power(-6, 3);
      C_s[g] = power(-6, 3);
      for (std::size_t s = 0; s < n; ++s) G[g][s] = random() % 3 == 0 ? 0 : power(-9, 20);
    }
    for (std::size_t g = 0; g < n; ++g)
      for (std::size_t s = 0; s < n; ++s) {
        S_g[g] += G[g][s];
        S_s[s] += G[g][s];
      }
    // All in front at 1, all behind at 0.
    for (std::size_t g = 0; g < n; ++g) {
      double given = 0, taken = 0;
      for (std::size_t s = 0; s < n; ++s) {
        given += passes(G[g][s], 1, S_g[g], 1 / C_g[g], S_s[s], 1 / C_s[s]);
        taken += passes(G[s][g], 1, S_g[s], 1 / C_g[s], S_s[g], 1 / C_s[g]);
      }
      EXPECT_LE(given, C_g[g] * (1 + 1e-14));
      EXPECT_LE(taken, C_s[g] * (1 + 1e-14));
      EXPECT_GE(given, 0);
    }
  }
}

}  // namespace
}  // namespace sluice::mpmice::surface_exchange_test
