// A row of a law has in every cell what the law of that cell says alone.
#include "ice/fluid/law_row.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "eos/eos_test_support.hpp"
#include "ice/fluid/laws_in_box.hpp"
#include "ice/test_support/fluid.hpp"

namespace sluice::ice::law_row_test {
namespace {

constexpr int n = 7;
using Values = std::array<double, n>;

// Three nodes: rows look for theirs.
models::MixedGas three_gases() {
  models::MixedGas gas;
  gas.material = 1;
  gas.set_nodes(
      {{0, 700, 280, 1e-5, .02, 0}, {.3, 900, 300, 3e-5, .05, 0}, {1, 3000, 2000, 2e-5, .1, 0}});
  return gas;
}

struct State {
  Values f, rho, E;
  State() {
    for (int i = 0; i < n; ++i) {
      f[i] = -.1 + .2 * i;  // beyond both ends too
      rho[i] = 1 + .1 * i;
      E[i] = 2e5 * (1 + .2 * i);
    }
  }
};

std::vector<Fluid> plain_laws() {
  return {ideal_gas(1.4, 717.5),
          stiffened_gas(4.4, 6e5),
          {eos::IdealGas{1.3, 900}, eos::SpecificHeat{eos::ConstantHeat{900}}, 1.3, 900}};
}

// The rows of `law` against the law of each cell.
void expect_cell_by_cell(const LawRow& law, const State& s) {
  Values p, p_too, p_of_primitives, K, K_too, w, c, c_too, kappa, T, cv;
  law.pressure(n, s.rho.data(), s.E.data(), p.data());
  law.pressure_and_modulus(n, s.rho.data(), s.E.data(), p_too.data(), K.data());
  law.modulus(n, s.rho.data(), p.data(), K_too.data());
  law.primitives(n, s.rho.data(), s.E.data(), w.data(), p_of_primitives.data(), c.data());
  law.sound_speed(n, s.rho.data(), p.data(), c_too.data());
  law.compressibility(n, s.rho.data(), p.data(), kappa.data());
  law.temperature(n, s.rho.data(), s.E.data(), T.data());
  law.heat_capacity(n, s.rho.data(), s.E.data(), cv.data());
  Fluid room;
  constexpr double round_off = 1e-14;
  for (std::size_t i = 0; i < n; ++i) {
    const Fluid& here = law.at(static_cast<int>(i), room);
    const auto expect = [&](double found, double expected) {
      EXPECT_NEAR(found / expected, 1.0, round_off) << "cell " << i;
    };
    const double pressure = here.pressure(s.rho[i], s.E[i]);
    for (const double found : {p[i], p_too[i], p_of_primitives[i]}) expect(found, pressure);
    const double modulus = here.bulk_modulus(s.rho[i], pressure);
    for (const double found : {K[i], K_too[i], 1 / kappa[i]}) expect(found, modulus);
    expect(w[i], 1 / s.rho[i]);
    for (const double found : {c[i], c_too[i]}) expect(found, std::sqrt(modulus / s.rho[i]));
    expect(T[i], here.temperature(s.rho[i], s.E[i]));
    expect(cv[i], here.heat_capacity(s.rho[i], s.E[i]));
  }
}

TEST(LawRow, OfPlainLawsIsThatOfEachCell) {
  const State s;
  for (const Fluid& fluid : plain_laws()) {
    const LawRow law(fluid);
    State pressed = s;
    if (fluid.lowest_pressure() < 0)
      for (double& E : pressed.E) E += 1e6;  // beyond the tension of the liquid
    expect_cell_by_cell(law, pressed);
    Fluid room;
    EXPECT_EQ(&law.at(2, room), &fluid);
    EXPECT_EQ(law.takes_any_number(), fluid.gamma_law() != nullptr);
  }
}

TEST(LawRow, OfAGasByFractionIsThatOfEachCell) {
  const State s;
  const models::MixedGas gas = three_gases();
  const LawRow law(gas, FractionRows(s.f.data()));
  expect_cell_by_cell(law, s);
  EXPECT_FALSE(law.takes_any_number());
  Fluid room;
  for (std::size_t i = 0; i < n; ++i) {
    const Fluid& here = law.at(static_cast<int>(i), room);
    EXPECT_EQ(here.gamma, gas.gamma(s.f[i]));
    EXPECT_EQ(here.specific_heat, gas.specific_heat(s.f[i]));
  }
}

// What a deck gives a material holds for plain laws; a gas by fraction has its own.
TEST(LawRow, HasCoefficientsOfTheDeckOrOfTheFraction) {
  const State s;
  const models::MixedGas gas = three_gases();
  const Fluid air = ideal_gas(1.4, 717.5);
  const LawRow plain(air), composed(gas, FractionRows(s.f.data()));
  Values mu, k;
  plain.viscosity(n, 4e-5, mu.data());
  plain.conductivity(n, .3, k.data());
  for (std::size_t i = 0; i < n; ++i) {
    EXPECT_EQ(mu[i], 4e-5);
    EXPECT_EQ(k[i], .3);
    EXPECT_EQ(plain.conductivity(static_cast<int>(i), .3), .3);
  }
  composed.viscosity(n, 4e-5, mu.data());
  composed.conductivity(n, .3, k.data());
  for (std::size_t i = 0; i < n; ++i) {
    EXPECT_EQ(mu[i], gas.at(s.f[i])(&models::MixedGas::Node::viscosity));
    EXPECT_EQ(k[i], gas.at(s.f[i])(&models::MixedGas::Node::conductivity));
    EXPECT_EQ(composed.conductivity(static_cast<int>(i), .3), k[i]);
  }
}

// k + cp mu_t/Pr_t with the cp of each cell.
TEST(LawRow, AddsWhatEddiesConduct) {
  const State s;
  const models::MixedGas gas = three_gases();
  const Fluid air = ideal_gas(1.4, 717.5);
  Values mu_t, k;
  mu_t.fill(1e-3);
  for (const LawRow& law : {LawRow(air), LawRow(gas, FractionRows(s.f.data()))}) {
    law.conductivity_with_eddies(n, .3, .9, s.rho.data(), s.E.data(), mu_t.data(), k.data());
    Fluid room;
    for (int i = 0; i < n; ++i) {
      const Fluid& here = law.at(i, room);
      const double cp = here.gamma * here.specific_heat;
      EXPECT_NEAR(k[i], law.conductivity(i, .3) + cp * 1e-3 / .9, 1e-14 * k[i]);
    }
  }
}

// Of each law: the cp of the state, which is the slope of enthalpy along a line of one pressure.
TEST(LawRow, EddiesConductByTheHeatCapacityOfTheState) {
  for (const eos::EquationOfState& any : eos::one_of_each()) {
    const Fluid fluid{any, std::nullopt, 1.4, 717.5};
    const bool coherent = !std::holds_alternative<eos::Tillotson>(any) &&
                          !std::holds_alternative<eos::MieGruneisen>(any);  // no one entropy
    const double T = 310, p = 2e5, rho = fluid.density(p, T);
    if (!coherent || std::isnan(rho)) continue;
    const auto enthalpy = [&](double t) {
      const double r = fluid.density(p, t);
      return (fluid.energy_from_temperature(r, t) + p) / r;
    };
    const double cp = (enthalpy(T + .5) - enthalpy(T - .5));
    const double E = fluid.energy_from_temperature(rho, T), mu_t = 1e-3;
    double k = 0;
    LawRow(fluid).conductivity_with_eddies(1, .3, .9, &rho, &E, &mu_t, &k);
    EXPECT_NEAR(k, .3 + cp * mu_t / .9, 2e-4 * k) << eos::name_of(any);
  }
}

TEST(LawsInBox, AreThoseOfTheFractionInTheCell) {
  const models::MixedGas gas = three_gases();
  const std::vector<Fluid> fluids = plain_laws();
  Values f{.1, .2, .5};
  RealView fraction;
  fraction.data = f.data();
  fraction.box = {{4, 0, 0}, {4 + n, 1, 1}};
  const LawsInBox laws{fluids, &gas, {fraction}}, plain{fluids};
  Fluid room;
  EXPECT_TRUE(plain.all_plain());
  EXPECT_FALSE(laws.all_plain());
  EXPECT_EQ(&laws.at({6, 0, 0}, 0, room), &fluids[0]);
  EXPECT_EQ(&plain.at({6, 0, 0}, 1, room), &fluids[1]);
  EXPECT_EQ(laws.at({6, 0, 0}, 1, room).gamma, gas.gamma(.5));
  struct Closure {
    int material = -1;
    double gamma = 0;
    void set_law(int m, const Fluid& fluid) {
      material = m;
      gamma = fluid.gamma;
    }
  } closure;
  plain.set(closure, {5, 0, 0});
  EXPECT_EQ(closure.material, -1);
  laws.set(closure, {5, 0, 0});
  EXPECT_EQ(closure.material, 1);
  EXPECT_EQ(closure.gamma, gas.gamma(.2));
}

}  // namespace
}  // namespace sluice::ice::law_row_test
