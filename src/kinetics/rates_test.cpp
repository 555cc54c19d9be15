// Net rates: by hand, at equilibrium, in the limits of falloff; their derivatives.
#include "kinetics/rates.hpp"

#include <gtest/gtest.h>

#include "kinetics/gas_test_support.hpp"

namespace sluice::kinetics::rates_test {
namespace {

using namespace testing_gas;

// A + A <=> B + B of constant specific heats, B with more enthalpy and entropy.
Mechanism two_species() {
  Mechanism m;
  m.elements = {"A"};
  m.species = {plain_species("A"), plain_species("B", 2000, 1.5)};
  Reaction reaction;
  reaction.reactants = {{0, 2}};
  reaction.products = {{1, 2}};
  reaction.rate = {3, 1.5, 9000};
  m.reactions = {reaction};
  return m;
}

std::vector<double> mixed() {
  return {1e-3, 0.9, 2e-3, 5e-3, 0.4, 0.6, 1e-4, 2e-5, 3.0};
}

TEST(Rates, FollowTheLawOfArrhenius) {
  Rates rates{SpeciesGas(two_species(), 1)};
  const double T = 800, k = 3 * std::pow(T, 1.5) * std::exp(-9000 / (molar_gas_constant * T));
  rates.at(T);
  EXPECT_NEAR(rates.forward(0), k, 1e-12 * k);
  const double Kc = std::exp(-2 * (2000 / T - 1.5));
  EXPECT_NEAR(rates.backward(0), k / Kc, 1e-9 * k / Kc);
  const double c[2] = {0.3, 0.2};
  double omega[2];
  rates.production(c, omega);
  const double expected = k * (0.09 - 0.04 / Kc);
  EXPECT_NEAR(omega[1], 2 * expected, 1e-9 * k);
  EXPECT_EQ(omega[0], -omega[1]);
}

TEST(Rates, ReactionsOneWayDoNotGoBack) {
  Mechanism m = two_species();
  m.reactions[0].reversible = false;
  Rates rates{SpeciesGas(m, 1)};
  rates.at(900);
  const double c[2] = {0, 1};
  double omega[2];
  rates.production(c, omega);
  EXPECT_EQ(omega[0], 0);
}

TEST(Rates, KeepAtoms) {
  Rates rates(hydrogen());
  std::vector<double> omega(9), c = mixed();
  for (double T : {300.0, 1200.0, 2800.0}) {
    rates.at(T);
    rates.production(c.data(), omega.data());
    for (std::size_t e = 0; e < 3; ++e) {
      double sum = 0, size = 0;
      for (std::size_t k = 0; k < 9; ++k) {
        sum += burke_hydrogen().species[k].atoms[e] * omega[k];
        size += std::abs(burke_hydrogen().species[k].atoms[e] * omega[k]);
      }
      EXPECT_LE(std::abs(sum), 1e-13 * size) << T;
    }
  }
}

TEST(Rates, VanishWhereTheGasIsAtEquilibrium) {
  const double rho = density(hydrogen(), hydrogen_air(), 101325, 1000);
  const auto [T, c] = burnt(concentrations(hydrogen(), rho, hydrogen_air()), 1000);
  ASSERT_GT(T, 2500);
  ASSERT_LT(T, 3500);
  // Every reaction rests by itself.
  for (const Reaction& reaction : burke_hydrogen().reactions) {
    Mechanism one = burke_hydrogen();
    one.reactions = {reaction};
    Rates rates{SpeciesGas(one, N2)};
    rates.at(T);
    std::vector<double> omega(9), forth = c;
    rates.production(c.data(), omega.data());
    one.reactions[0].reversible = false;
    Rates one_way{SpeciesGas(one, N2)};
    one_way.at(T);
    one_way.production(c.data(), forth.data());
    for (std::size_t k = 0; k < 9; ++k)
      EXPECT_LE(std::abs(omega[k]), 1e-11 * std::abs(forth[k])) << reaction.equation;
  }
}

TEST(Rates, DerivativesAreThoseOfDifferences) {
  Rates rates(hydrogen());
  const std::vector<double> c = mixed();
  std::vector<double> by_c(81), by_T(9), above(9), below(9);
  const double T = 1400;
  const auto at = [&](double t, const std::vector<double>& state, std::vector<double>& omega) {
    rates.at(t);
    rates.production(state.data(), omega.data());
  };
  rates.at(T);
  rates.derivatives(c.data(), by_c.data(), by_T.data());
  double size = 0;
  for (const double slope : by_c) size = std::max(size, std::abs(slope));
  for (std::size_t j = 0; j < 9; ++j) {
    std::vector<double> up = c, down = c;
    const double h = 1e-5 * c[j];
    up[j] += h;
    down[j] -= h;
    at(T, up, above);
    at(T, down, below);
    for (std::size_t i = 0; i < 9; ++i)
      EXPECT_NEAR(by_c[j * 9 + i], (above[i] - below[i]) / (2 * h), 1e-7 * size) << i << ' ' << j;
  }
  at(T + 0.05, c, above);
  at(T - 0.05, c, below);
  for (std::size_t i = 0; i < 9; ++i)
    EXPECT_NEAR(by_T[i], (above[i] - below[i]) / 0.1, 1e-6 * std::abs(by_T[i]) + 1e-9) << i;
}

TEST(Falloff, HasBothLimits) {
  // Troe's form leaves lg F about a fiftieth of lg Fc at the limits.
  for (const bool troe : {false, true}) {
    const double centre = std::log10(0.5);
    EXPECT_NEAR(falloff_factor(1e-40, troe, centre).value / 1e-40, 1, 0.03);
    EXPECT_NEAR(falloff_factor(1e40, troe, centre).value, 1, 0.03);
  }
  EXPECT_DOUBLE_EQ(falloff_factor(1, false, 0).value, 0.5);
  EXPECT_NEAR(
      falloff_factor(std::pow(10, 0.4 + 0.67 * std::log10(0.5)), true, std::log10(0.5)).value /
          falloff_factor(std::pow(10, 0.4 + 0.67 * std::log10(0.5)), false, 0).value,
      0.5, 1e-12);
}

TEST(Falloff, SlopesAreThoseOfDifferences) {
  const double h = 1e-5;
  for (double P : {1e-3, 0.7, 50.0})
    for (double centre : {-0.3, -0.05}) {
      const auto log = [](double p, double lg) {
        return std::log(falloff_factor(p, true, lg).value);
      };
      const FalloffFactor f = falloff_factor(P, true, centre);
      EXPECT_NEAR(f.by_log_P, (log(P * (1 + h), centre) - log(P * (1 - h), centre)) / (2 * h),
                  1e-8);
      EXPECT_NEAR(f.by_centre, (log(P, centre + h) - log(P, centre - h)) / (2 * h), 1e-8);
    }
  Falloff falloff;
  falloff.a = 0.6;
  falloff.T3 = 100;
  falloff.T1 = 900;
  falloff.T2 = 5000;
  EXPECT_NEAR(log_centre(falloff, 800).slope,
              (log_centre(falloff, 800.1).value - log_centre(falloff, 799.9).value) / 0.2, 1e-9);
}

}  // namespace
}  // namespace sluice::kinetics::rates_test
