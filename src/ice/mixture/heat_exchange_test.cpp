// Heat between materials of a cell: what it keeps, also of next to nothing beside a liquid.
#include "ice/mixture/heat_exchange.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace sluice::ice::mixture {
namespace {

PairCoefficients all_pairs(int materials, double H) {
  PairCoefficients pairs(materials);
  for (int m = 0; m < materials; ++m)
    for (int n = 0; n < m; ++n) pairs.set(m, n, H);
  return pairs;
}

Fluid water() {
  eos::StiffenedGas law;
  law.gamma = 4.4;
  law.pinf = 6e8;
  law.specific_heat = 4180;
  return {law, std::nullopt, 4.4, 4180};
}

double temperature(const Fluid& fluid, double M, double V, double E) {
  return fluid.temperature(M / V, E / V);
}

// What a cavity holds: 1e-31 kg of gas at 1e-12 of the liquid's pressure is hotter than any star.
TEST(HeatExchange, NextToNothingTakesTheTemperatureOfTheLiquid) {
  const std::vector<Fluid> fluids = {ideal_gas(3, 3000), water()};
  for (const double mass : {1e-4, 1e-12, 1e-20, 1e-31, 1e-60}) {
    double M[] = {mass, 992}, V[] = {0.008, 0.992};
    double E[] = {1e-6, V[1] * fluids[1].energy_from_temperature(1000, 750)};
    const double before = E[0] + E[1];
    ASSERT_TRUE(HeatExchange(fluids, all_pairs(2, 1e15)).exchange({M, V, E}, 1e-6));
    EXPECT_GT(E[0], 0) << mass;
    EXPECT_NEAR(temperature(fluids[0], M[0], V[0], E[0]), 750, 1e-4) << mass;
    EXPECT_DOUBLE_EQ(E[0] + E[1], before);
  }
}

// The second-order method for three and more overshoots where the exchange is stiff.
TEST(HeatExchange, TemperaturesStayBetweenThoseBefore) {
  const std::vector<Fluid> fluids = {ideal_gas(1.4, 717.5), ideal_gas(1.667, 3000), water()};
  std::mt19937 random(7);
  std::uniform_real_distribution<double> digits(-12, 4), hot(2, 6);
  for (int n = 0; n < 2000; ++n) {
    double M[3], T[3], E[3], V[] = {0.1, 0.3, 0.6}, energy = 0;
    for (std::size_t m = 0; m < 3; ++m) {
      M[m] = m == 2 ? 600 : V[m] * std::pow(10.0, std::min(digits(random), 1.0));
      T[m] = m == 2 ? 300 : std::pow(10.0, hot(random));
      E[m] = V[m] * fluids[m].energy_from_temperature(M[m] / V[m], T[m]);
      energy += E[m];
    }
    const double coldest = *std::min_element(T, T + 3), hottest = *std::max_element(T, T + 3);
    HeatExchange(fluids, all_pairs(3, std::pow(10.0, digits(random) + 6))).exchange({M, V, E}, 1.0);
    for (std::size_t m = 0; m < 3; ++m) {
      const double now = temperature(fluids[m], M[m], V[m], E[m]);
      EXPECT_GE(now, coldest * (1 - 1e-9)) << n << ' ' << m;
      EXPECT_LE(now, hottest * (1 + 1e-9)) << n << ' ' << m;
    }
    EXPECT_NEAR((E[0] + E[1] + E[2]) / energy, 1, 4e-16);
  }
}

}  // namespace
}  // namespace sluice::ice::mixture
