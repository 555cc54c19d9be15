// Heat between materials of a cell: the exponential for any coefficient, and what it keeps, also of
// next to nothing beside a liquid.
#include "ice/closure/heat_exchange.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "ice/test_support/fluid.hpp"

namespace sluice::ice::mixture::heat_exchange_test {
namespace {

PairCoefficients all_pairs(int materials, double H) {
  PairCoefficients pairs(materials);
  for (int m = 0; m < materials; ++m)
    for (int n = 0; n < m; ++n) pairs.set(m, n, H);
  return pairs;
}

const Fluid water = stiffened_gas(4.4, 6e8, 4180);

double temperature(const Fluid& fluid, double M, double V, double E) {
  return fluid.temperature(M / V, E / V);
}

// What a cavity holds: 1e-31 kg of gas at 1e-12 of the liquid's pressure is hotter than any star.
TEST(HeatExchange, NextToNothingTakesTheTemperatureOfTheLiquid) {
  const std::vector<Fluid> fluids = {ideal_gas(3, 3000), water};
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
  const std::vector<Fluid> fluids = {ideal_gas(1.4, 717.5), ideal_gas(1.667, 3000), water};
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

const Fluid air = ideal_gas(1.4, 717), helium = ideal_gas(1.667, 3115);

struct Cell {
  double M[2], V[2], E[2];
  double temperature(int m) const {
    return (m == 0 ? air : helium).temperature(M[m] / V[m], E[m] / V[m]);
  }
};
Cell cell_of(double V, double rho_air, double rho_helium) {
  return {{V * rho_air, (1 - V) * rho_helium},
          {V, 1 - V},
          {V * rho_air * 717 * 900, (1 - V) * rho_helium * 3115 * 300}};
}

// r: heavier mass over lighter one; what linearVariation makes of a coefficient.
double growth(double r) {
  return std::fmin(std::fmax(r * r, 1e5), 1e12) / 1e5;
}

TEST(HeatExchange, IsTheExponentialForAnyCoefficient) {
  const double dt = 1e-3;
  for (const bool varies : {false, true})
    for (const double V : {.3, 1e-3, 1e-7})
      for (double H = 0; H <= 1e15; H = H == 0 ? 1e-3 : H * 1e3) {
        PairCoefficients coefficient(2);
        coefficient.set(0, 1, H);
        if (varies) coefficient.vary_with_mass();
        const HeatExchange exchange({air, helium}, coefficient);
        Cell cell = cell_of(V, 1.2, .2);
        const double before = cell.E[0] + cell.E[1], differ = 600;
        const double r = std::fmax(cell.M[0] / cell.M[1], cell.M[1] / cell.M[0]);
        const double rate = H * (varies ? growth(r) : 1.0) * V * (1 - V) *
                            (1 / (cell.M[0] * 717) + 1 / (cell.M[1] * 3115));
        exchange.exchange({cell.M, cell.V, cell.E}, dt);
        const double exact = differ * std::exp(-dt * rate);
        EXPECT_NEAR(cell.temperature(0) - cell.temperature(1), exact, 1e-11 * differ)
            << V << " " << H;
        EXPECT_NEAR((cell.E[0] + cell.E[1]) / before, 1, 4e-16);
      }
}

// Through a surface the two resist one after the other; without one only the coefficient does.
TEST(HeatExchange, PassesASurface) {
  MultiVelocityExchange slip;
  slip.fluid = 1;
  slip.solid = 0;
  const double dt = 1e-3, h = 5e4, V = .3;
  for (const double H : {1e3, 1e6, 1e15})
    for (const double share : {0., .5, 1.}) {
      PairCoefficients coefficient(2);
      coefficient.set(0, 1, H);
      Cell cell = cell_of(V, 1.2, .2);
      HeatExchange({air, helium}, coefficient, slip)
          .exchange({cell.M, cell.V, cell.E}, dt, {share, h});
      const double all = H * V * (1 - V);
      const double passes = share / (1 / all + 1 / h) + (1 - share) * all;
      const double rate = passes * (1 / (cell.M[0] * 717) + 1 / (cell.M[1] * 3115));
      EXPECT_NEAR(cell.temperature(0) - cell.temperature(1), 600 * std::exp(-dt * rate), 1e-8)
          << H << " " << share;
    }
}

// A trace is bound by the same coefficient that hardly couples it otherwise.
TEST(HeatExchange, LinearVariationBindsTraces) {
  PairCoefficients coefficient(2);
  coefficient.set(0, 1, 1e5);
  const auto left = [&] {
    Cell cell = cell_of(1 - 1e-6, .2, 1000);
    HeatExchange({air, helium}, coefficient).exchange({cell.M, cell.V, cell.E}, 1e-6);
    return (cell.temperature(0) - cell.temperature(1)) / 600;
  };
  EXPECT_NEAR(left(), 1, 1e-2);
  coefficient.vary_with_mass();
  EXPECT_NEAR(left(), std::exp(-1e-6 * 1e5 * growth(.2 * (1 - 1e-6) / 1e-3) * (1 / 3115e3)), 1e-2);
}

}  // namespace
}  // namespace sluice::ice::mixture::heat_exchange_test
