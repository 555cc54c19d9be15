// One pressure of the materials of a cell: what is kept, what holds at the end, hard cells.
#include "ice/closure/equilibrate.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "eos/eos_test_support.hpp"
#include "ice/test_support/mixture.hpp"

namespace sluice::ice::mixture::equilibrate_test {
namespace {

struct State {
  double M[2], V[2], E[2];
  Equilibration::Cell cell() { return {M, V, E}; }
};

// Shares V and 1 - V of materials at densities and pressures of their own.
State mixed(const Fluid& a, const Fluid& b, double V, double rho_a, double p_a, double rho_b,
            double p_b) {
  State s{{V * rho_a, (1 - V) * rho_b}, {V, 1 - V}, {}};
  s.E[0] = V * a.energy_from_pressure(rho_a, p_a, 300);
  s.E[1] = (1 - V) * b.energy_from_pressure(rho_b, p_b, 300);
  return s;
}

void expect_one_pressure(const Fluid& a, const Fluid& b, State s) {
  const double energy = s.E[0] + s.E[1], size = std::fabs(s.E[0]) + std::fabs(s.E[1]);
  const auto result = Equilibration({a, b}).equilibrate(s.cell());
  ASSERT_EQ(result.failed, -1);
  EXPECT_DOUBLE_EQ(s.V[0] + s.V[1], 1.0);
  EXPECT_LE(std::fabs(s.E[0] + s.E[1] - energy), 4e-16 * size);
  const Fluid* fluids[] = {&a, &b};
  for (int m = 0; m < 2; ++m) {
    const double rho = s.M[m] / s.V[m], p = fluids[m]->pressure(rho, s.E[m] / s.V[m]);
    EXPECT_LE(std::fabs(p - result.pressure), 1e-13 * fluids[m]->bulk_modulus(rho, p));
  }
  // What is in equilibrium stays as it is, to the bit.
  const State before = s;
  Equilibration({a, b}).equilibrate(s.cell());
  for (int m = 0; m < 2; ++m) {
    EXPECT_EQ(s.V[m], before.V[m]);
    EXPECT_EQ(s.E[m], before.E[m]);
  }
}

TEST(Equilibration, FindsOnePressureForAnyPair) {
  const Fluid air = ideal_gas(1.4, 717), heavy = ideal_gas(1.667, 300);
  const Fluid water = stiffened_gas(4.4, 6e8);
  for (const double V : {.5, 1e-4, 1 - 1e-4, 1e-12}) {
    expect_one_pressure(air, heavy, mixed(air, heavy, V, 1, 1e5, 10, 5e5));
    expect_one_pressure(water, air, mixed(water, air, V, 1000, 1e9, 1.2, 1e5));
    expect_one_pressure(water, air, mixed(water, air, V, 1000, 1e5, 50, 1e7));
    expect_one_pressure(jwl(), air, mixed(jwl(), air, V, 1840, 2e10, 50, 1e9));
  }
}

// A weak liquid that is torn already: of its energy above the least nothing is left but round-off.
TEST(Equilibration, WeakLiquidsOpenWithNothingButRoundOff) {
  const Fluid weak = stiffened_gas(3, 1e6), water = stiffened_gas(4.4, 6e8);
  int is_cavitating = 0;
  for (int n = 0; n < 200; ++n) {
    const double V = 1e-4 * (1 + 0.01 * n);
    State s{{1e-30, (1 - V) * 900}, {V, 1 - V}, {}};
    s.E[0] = 1e6 * V;
    for (int up = 0; up < n % 3; ++up) s.E[0] = std::nextafter(s.E[0], 1e9);
    s.E[1] = s.V[1] * water.energy_from_pressure(900, -5e8, 300);
    const double energy = s.E[0] + s.E[1];
    const auto result = Equilibration({weak, water}).equilibrate(s.cell());
    EXPECT_EQ(result.failed, -1);
    is_cavitating += result.is_cavitating;
    EXPECT_GT(s.V[0], 1e-2);
    EXPECT_DOUBLE_EQ(s.E[0] + s.E[1], energy);
  }
  EXPECT_EQ(is_cavitating, 200);
}

// Three liquids of much the same strength, of which the weakest is about to open: the sum of the
// pressure and pi, of which its volume tells, is next to nothing beside both.
TEST(Equilibration, LiquidsThatAreAboutToOpenFindTheirPressure) {
  const double strength[] = {1e6, 1.5e6, 3e6}, gamma[] = {3, 4.4, 2};
  std::vector<Fluid> fluids;
  for (int m = 0; m < 3; ++m) fluids.push_back(stiffened_gas(gamma[m], strength[m]));
  for (int n = 0; n <= 60; ++n)
    for (const double change : {1e-3, .1}) {
      const double above = 3.5e-6 * std::pow(10, .1 * n), q = above - strength[0];
      const double ends[] = {.3, .2, .5};
      double V[] = {.3 * (1 - change), .2 * (1 + change), 0}, M[3], E[3], energy = 0;
      V[2] = 1 - V[0] - V[1];
      for (int m = 0; m < 3; ++m) {
        M[m] = m == 0 ? 1e-9 : 900 * ends[m];
        E[m] = ends[m] * (q + gamma[m] * strength[m]) / (gamma[m] - 1) + q * (ends[m] - V[m]);
        energy += E[m];
      }
      const auto result = Equilibration(fluids).equilibrate({M, V, E});
      ASSERT_EQ(result.failed, -1) << above << " " << change;
      EXPECT_FALSE(result.is_cavitating);
      EXPECT_NEAR(V[0], ends[0], 1e-15 * strength[0] / above);
      EXPECT_DOUBLE_EQ(V[0] + V[1] + V[2], 1);
      EXPECT_DOUBLE_EQ(E[0] + E[1] + E[2], energy);
    }
}

// A metal that is pulled apart where next to nothing of a gas is: the gas holds the cavity open.
TEST(Equilibration, GasOpensAMetalUnderTension) {
  const Fluid metal{eos::copper, std::nullopt, 1, 1000}, gas = ideal_gas(1.4, 717);
  for (const double V : {1e-12, 1e-5, 1e-2})
    for (const double M : {1e-86, 1e-30}) {
      State s{{M, (1 - V) * 8500}, {V, 1 - V}, {}};
      s.E[0] = M * 717 * 300;
      s.E[1] = s.M[1] * metal.energy_from_temperature(8500, 300) / 8500;
      ASSERT_LT(metal.pressure(8500, s.E[1] / s.V[1]), -1e9);
      const double energy = s.E[0] + s.E[1];
      const auto result = Equilibration({gas, metal}).equilibrate(s.cell());
      EXPECT_EQ(result.failed, -1);
      EXPECT_TRUE(result.is_cavitating);
      EXPECT_GT(result.pressure, 0);
      EXPECT_LT(result.pressure, 1);
      EXPECT_NEAR(s.V[0], 0.05, 0.02);
      const double K = metal.bulk_modulus(s.M[1] / s.V[1], 0);
      EXPECT_NEAR(metal.pressure(s.M[1] / s.V[1], s.E[1] / s.V[1]), result.pressure, 1e-12 * K);
      EXPECT_DOUBLE_EQ(s.E[0] + s.E[1], energy);
      EXPECT_DOUBLE_EQ(s.V[0] + s.V[1], 1.0);
    }
}

// As a trace of gas does: torn matter is dust, which knows no tension.
TEST(Equilibration, TracesOfASolidOpenALiquidUnderTension) {
  const Fluid water = stiffened_gas(4.4, 6e8);
  eos::Murnaghan law;
  law.n = 7.4;
  law.K = 39e-11;
  law.rho0 = 1160;
  law.specific_heat = 1000;
  const Fluid solid{law, std::nullopt, 1, 1000};
  const double rho = solid.density(1e5, 300), V = 3e-14;
  State s{{(1 - V) * 958, V * rho}, {1 - V, V}, {}};
  s.E[0] = (1 - V) * water.energy_from_pressure(958, -1e6, 300);
  s.E[1] = V * solid.energy_from_temperature(rho, 300);
  const double energy = s.E[0] + s.E[1];
  const auto result = Equilibration({water, solid}).equilibrate(s.cell());
  EXPECT_EQ(result.failed, -1);
  EXPECT_GT(result.pressure, 0);
  EXPECT_LT(result.pressure, 1e-6);
  EXPECT_NEAR(s.E[0] / s.V[0], water.energy_from_pressure(s.M[0] / s.V[0], 0, 300), 1);
  EXPECT_NEAR(solid.pressure(s.M[1] / s.V[1], s.E[1] / s.V[1]), result.pressure, 1e-6);
  EXPECT_DOUBLE_EQ(s.E[0] + s.E[1], energy);
  EXPECT_DOUBLE_EQ(s.V[0] + s.V[1], 1.0);
}

// The round-off of large fluxes left it below what its law knows (a trace after the remap).
TEST(Equilibration, NextToNothingWithoutAStateTakesItsLeastPressure) {
  const Fluid weak = stiffened_gas(3, 1e6), water = stiffened_gas(4.4, 6e8);
  State s{{1e-20, (1 - 1e-11) * 958}, {1e-11, 1 - 1e-11}, {}};
  s.E[0] = s.V[0] * 1e6 * (1 - 1e-9);  // p = -1e6 (1 + 2e-9)
  s.E[1] = s.V[1] * water.energy_from_pressure(958, 1e5, 300);
  const double energy = s.E[0] + s.E[1];
  const auto result = Equilibration({weak, water}).equilibrate(s.cell());
  EXPECT_EQ(result.failed, -1);
  EXPECT_NEAR(result.pressure, 1e5, 10);
  EXPECT_DOUBLE_EQ(s.E[0] + s.E[1], energy);
  // What is more than nothing ends the step.
  State heavy = s;
  heavy.M[0] = 1e-3;
  heavy.E[0] = s.V[0] * 1e6 * (1 - 1e-9);
  EXPECT_EQ(Equilibration({weak, water}).equilibrate(heavy.cell()).failed, 0);
}

// Two liquids that are pulled apart: the weaker one gives way, as a gas beside a liquid does.
TEST(Equilibration, TheWeakerLiquidOpensUnderTension) {
  const Fluid weak = stiffened_gas(3, 1e6), water = stiffened_gas(4.4, 6e8);
  State s{{1e-15, 900}, {1e-4, 1 - 1e-4}, {}};
  s.E[0] = s.V[0] * weak.energy_from_pressure(s.M[0] / s.V[0], -1e6 + 1, 300);
  s.E[1] = s.V[1] * water.energy_from_pressure(900, -5e8, 300);
  const double energy = s.E[0] + s.E[1];
  const auto result = Equilibration({weak, water}).equilibrate(s.cell());
  EXPECT_EQ(result.failed, -1);
  EXPECT_TRUE(result.is_cavitating);
  EXPECT_GT(result.pressure, -1e6);
  EXPECT_LT(result.pressure, -1e6 + 1);
  EXPECT_GT(s.V[0], 1e-2);
  EXPECT_DOUBLE_EQ(s.E[0] + s.E[1], energy);
  EXPECT_DOUBLE_EQ(s.V[0] + s.V[1], 1.0);
}

// Cold water that fluxes have left with an energy of no state, in air below the temperature at
// which water is densest: it takes the temperature and the pressure of the air.
TEST(Equilibration, MendsTracesOfAnyLaw) {
  const Fluid air = ideal_gas(1.4, 716.5);
  const Fluid water{eos::ThomsenHartkaWater{}, std::nullopt, 1.000009, 4145};
  const Equilibration equilibration({air, water});
  double M[] = {1.28699, 5.44715e-21}, V[] = {1.0, 5.74001e-24}, E[] = {253931.0, -2.45999e-14};
  const double sum = E[0] + E[1];
  const auto result = equilibration.equilibrate({M, V, E});
  EXPECT_LT(result.failed, 0);
  EXPECT_NEAR(result.pressure, 0.4 * 253931, 1e-6);
  EXPECT_EQ(E[0] + E[1], sum);
  EXPECT_NEAR(V[0] + V[1], 1, 1e-15);
  const double rho = M[1] / V[1], rho_e = E[1] / V[1];
  EXPECT_NEAR(water.pressure(rho, rho_e), result.pressure, 1e-3);
  EXPECT_NEAR(water.temperature(rho, rho_e), air.temperature(M[0] / V[0], E[0] / V[0]), 1e-3);
}

// Water on either side of its greatest density, squeezed with air, stays on its side.
TEST(Equilibration, KeepsColdWaterCold) {
  const Fluid air = ideal_gas(1.4, 716.5);
  const Fluid water{eos::ThomsenHartkaWater{}, std::nullopt, 1.000009, 4145};
  const Equilibration equilibration({air, water});
  for (const double T : {270.0, 274.0, 280.0, 284.0})
    for (const double share : {1e-9, 1e-3, 0.5, 0.99}) {
      const double rho = water.density(2e5, T);
      double V[] = {1 - share, share}, M[] = {1.2 * V[0], rho * share};
      double E[] = {V[0] * 1e5 / 0.4, share * water.energy_from_temperature(rho, T)};
      const auto result = equilibration.equilibrate({M, V, E});
      EXPECT_LT(result.failed, 0) << T << " " << share;
      EXPECT_NEAR(water.temperature(M[1] / V[1], E[1] / V[1]), T, 0.01) << share;
      EXPECT_NEAR(water.pressure(M[1] / V[1], E[1] / V[1]), result.pressure,
                  1e-3 + 1e-9 * result.pressure);
    }
}

}  // namespace
}  // namespace sluice::ice::mixture::equilibrate_test
