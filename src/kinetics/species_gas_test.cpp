// Mixtures of species: heat capacity, formation, blending, and potentials that agree with them.
#include "kinetics/species_gas.hpp"

#include <gtest/gtest.h>

#include "framework/base/error.hpp"
#include "kinetics/gas_test_support.hpp"

namespace sluice::kinetics::species_gas_test {
namespace {

using namespace testing_gas;

TEST(SpeciesGas, HasTheHeatOfFormationOfSteam) {
  const SpeciesGas& gas = hydrogen();
  const auto h = [&](Place k) {
    return burke_hydrogen().species[k].molar_mass *
           (gas.sensible_enthalpy(k, 298.15) + gas.formation_energy(k));
  };
  EXPECT_NEAR(h(H2O), -241.8e3, 100);
  EXPECT_NEAR(h(H), 218.0e3, 100);
  EXPECT_NEAR(h(H2), 0, 10);
  EXPECT_NEAR(h(O2), 0, 10);
  EXPECT_NEAR(h(N2), 0, 10);
}

TEST(SpeciesGas, HeatCapacityIsTheSlopeOfAPositiveEnergy) {
  const SpeciesGas& gas = hydrogen();
  for (std::size_t k = 0; k < gas.count(); ++k)
    for (double T : {150.0, 310.0, 900.0, 1500.0, 3400.0, 4000.0}) {
      const eos::Nasa7Heat& heat = gas.heat_of(k);
      const double slope = (heat.energy(T + 0.1) - heat.energy(T - 0.1)) / 0.2;
      EXPECT_NEAR(slope, heat.specific_heat(T), 1e-6 * slope);
      EXPECT_GT(heat.energy(T), 0);
      EXPECT_GE(heat.specific_heat(T), gas.lowest_specific_heat());
      EXPECT_LE(heat.ratio(T), gas.highest_gamma());
    }
}

TEST(SpeciesGas, EnergyIsLinearInFractions) {
  const SpeciesGas& gas = hydrogen();
  std::vector<double> Y = {.01, .02, .03, .04, .05, .06, .07, .08}, all(9);
  gas.all_fractions(Y.data(), all.data());
  EXPECT_NEAR(all[N2], 0.64, 1e-15);
  const eos::Nasa7Heat heat = gas.heat([&](std::size_t k) { return Y[k]; });
  for (double T : {250.0, 600.0, 2000.0}) {
    double e = 0, R = 0;
    for (std::size_t k = 0; k < gas.count(); ++k) {
      e += all[k] * gas.sensible_energy(k, T);
      R += all[k] * gas.gas_constant(k);
    }
    EXPECT_NEAR(heat.energy(T), e, 1e-12 * e);
    EXPECT_NEAR(heat.gas_constant, R, 1e-12 * R);
    EXPECT_NEAR(heat.temperature(e), T, 1e-9 * T);
  }
}

TEST(SpeciesGas, RefusesAClosureThatIsNoSpecies) {
  EXPECT_THROW(SpeciesGas(burke_hydrogen(), 9), InputError);
}

TEST(SpeciesPotentials, AgreeWithTheEnergiesOfTheGas) {
  const SpeciesGas& gas = hydrogen();
  SpeciesPotentials potentials(gas);
  for (double T : {150.0, 298.15, 999.999, 1000.001, 2500.0, 3600.0}) {
    potentials.at(T);
    for (std::size_t k = 0; k < gas.count(); ++k) {
      const double h = gas.sensible_enthalpy(k, T) + gas.formation_energy(k);
      const double RT = gas.gas_constant(k) * T;
      EXPECT_NEAR(potentials.enthalpy()[k], h / RT, 1e-11 * (1 + std::abs(h / RT)));
    }
  }
}

TEST(SpeciesPotentials, GibbsEnergyFallsByTheEntropy) {
  SpeciesPotentials potentials(hydrogen());
  for (double T : {200.0, 300.0, 700.0, 1000.0, 2500.0, 3500.0, 4000.0}) {
    const double step = 1e-3 * T;
    potentials.at(T);
    const std::vector<double> h(potentials.enthalpy(), potentials.enthalpy() + 9);
    potentials.at(T + step);
    const std::vector<double> above(potentials.gibbs(), potentials.gibbs() + 9);
    potentials.at(T - step);
    for (std::size_t k = 0; k < 9; ++k)  // d(g/RT)/dT = -h/(R T^2)
      EXPECT_NEAR((above[k] - potentials.gibbs()[k]) / (2 * step) * T, -h[k],
                  2e-5 * (1 + std::abs(h[k])));
  }
}

TEST(SpeciesPotentials, HaveTheEntropyOfTables) {
  SpeciesPotentials potentials(hydrogen());
  potentials.at(298.15);
  const auto s = [&](Place k) {
    return molar_gas_constant * (potentials.enthalpy()[k] - potentials.gibbs()[k]);
  };
  EXPECT_NEAR(s(H2O), 188.7, 0.3);
  EXPECT_NEAR(s(O2), 205.1, 0.3);
  EXPECT_NEAR(s(H2), 130.6, 0.3);
}

}  // namespace
}  // namespace sluice::kinetics::species_gas_test
