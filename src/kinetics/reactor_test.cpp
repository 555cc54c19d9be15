// The reacting cell: closed forms, conservation, tolerances, independence of earlier calls.
#include "kinetics/reactor.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "framework/base/error.hpp"
#include "kinetics/gas_test_support.hpp"

namespace sluice::kinetics::reactor_test {
namespace {

using namespace testing_gas;

struct Cell {
  double rho, energy;
  std::vector<double> Y;
};

Cell cell(double T, double p = 101325, std::vector<double> Y = hydrogen_air()) {
  return {density(hydrogen(), Y, p, T), energy(hydrogen(), Y, T), Y};
}

// All fractions times energies of formation, J/kg.
double formation(const std::vector<double>& Y) {
  std::vector<double> all(9);
  hydrogen().all_fractions(Y.data(), all.data());
  double sum = 0;
  for (std::size_t k = 0; k < 9; ++k) sum += all[k] * hydrogen().formation_energy(k);
  return sum;
}

std::vector<double> atoms(const Cell& cell) {
  const std::vector<double> c = concentrations(hydrogen(), cell.rho, cell.Y);
  std::vector<double> sum(3, 0.0);
  for (std::size_t k = 0; k < 9; ++k)
    for (std::size_t e = 0; e < 3; ++e) sum[e] += c[k] * burke_hydrogen().species[k].atoms[e];
  return sum;
}

TEST(Reactor, DecaysLikeAnExponential) {
  Mechanism m;
  m.elements = {"A"};
  m.species = {plain_species("A"), plain_species("B")};
  m.reactions.resize(1);
  m.reactions[0].reactants = {{0, 1}};
  m.reactions[0].products = {{1, 1}};
  m.reactions[0].rate = {50, 0, 0};
  m.reactions[0].reversible = false;
  const SpeciesGas gas(m, 1);
  double earlier = 1;
  for (double relative : {1e-4, 1e-6, 1e-8, 1e-10}) {
    Reactor reactor(gas, {relative, 1e-6, relative * 1e-3});
    std::vector<double> Y = {0.8};
    const Reactor::Result result = reactor.advance(1.2, energy(gas, Y, 700), Y.data(), 0.03);
    const double error = std::abs(Y[0] / (0.8 * std::exp(-1.5)) - 1);
    EXPECT_LT(error, 30 * relative);
    EXPECT_LT(error, earlier / 5);
    EXPECT_NEAR(result.heat, 0, 1e-9 * 1.2 * energy(gas, Y, 700));
    earlier = error;
  }
}

TEST(Reactor, KeepsEnergyAndAtomsToRoundOff) {
  Reactor reactor(hydrogen(), {1e-5, 1e-3, 1e-8});  // loose: exactness does not come from it
  Cell c = cell(1100);
  const std::vector<double> before = atoms(c);
  double energy = c.energy;
  const double whole = energy + formation(c.Y);
  for (int step = 0; step < 40; ++step) {
    const Reactor::Result result = reactor.advance(c.rho, energy, c.Y.data(), 5e-6);
    energy += result.heat / c.rho;
    for (const double fraction : c.Y) EXPECT_GE(fraction, 0);
  }
  EXPECT_GT(temperature(hydrogen(), c.Y, energy), 2500);
  EXPECT_NEAR(energy + formation(c.Y), whole, 1e-13 * energy);
  const std::vector<double> after = atoms(c);
  for (std::size_t e = 0; e < 3; ++e) EXPECT_NEAR(after[e], before[e], 1e-13 * before[e]);
}

TEST(Reactor, LeavesNegativeFractionsOfTheStartAlone) {
  Reactor reactor(hydrogen(), {});
  Cell c = cell(1200);
  c.Y[H2O2] = -1e-9;
  const std::vector<double> before = atoms(c);
  reactor.advance(c.rho, c.energy, c.Y.data(), 1e-4);
  EXPECT_GT(c.Y[H2O2], -1e-9);
  EXPECT_GT(c.Y[H2O], 0.1);
  const std::vector<double> after = atoms(c);
  for (std::size_t e = 0; e < 3; ++e) EXPECT_NEAR(after[e], before[e], 1e-13 * before[e]);
}

TEST(Reactor, GivesTheSameBitsAfterOtherCalls) {
  const std::vector<double> temperatures = {1050, 1800, 300, 1300};
  const auto result_of = [&](Reactor& reactor, double T) {
    Cell c = cell(T);
    const Reactor::Result result = reactor.advance(c.rho, c.energy, c.Y.data(), 2e-5);
    c.Y.push_back(result.heat);
    c.Y.push_back(result.last_step);
    c.Y.push_back(static_cast<double>(result.steps));
    return c.Y;
  };
  Reactor one(hydrogen(), {});
  std::vector<std::vector<double>> forth, back(temperatures.size());
  for (const double T : temperatures) forth.push_back(result_of(one, T));
  Reactor other(hydrogen(), {});
  for (std::size_t n = temperatures.size(); n-- > 0;) back[n] = result_of(other, temperatures[n]);
  for (std::size_t n = 0; n < forth.size(); ++n) {
    EXPECT_EQ(forth[n], back[n]) << temperatures[n];
    Reactor fresh(hydrogen(), {});
    EXPECT_EQ(forth[n], result_of(fresh, temperatures[n])) << temperatures[n];
  }
}

TEST(Reactor, LeavesInertCells) {
  Reactor reactor(hydrogen(), {});
  std::vector<double> air(8, 0.0), burnt_cold(8, 0.0);
  air[O2] = 0.23;
  burnt_cold[H2O] = 0.2;
  for (const Cell& start :
       {cell(300), cell(500), cell(900, 101325, air), cell(400, 1e6, burnt_cold)}) {
    Cell c = start;
    const Reactor::Result result = reactor.advance(c.rho, c.energy, c.Y.data(), 1e-6);
    EXPECT_EQ(result.steps, 0);
    EXPECT_EQ(result.heat, 0);
    EXPECT_EQ(c.Y, start.Y);
  }
}

TEST(Reactor, IntegratesWhatIsSlowButIgnites) {
  Reactor reactor(hydrogen(), {});
  Cell c = cell(900);
  EXPECT_GT(reactor.advance(c.rho, c.energy, c.Y.data(), 1e-9).steps, 0);
  EXPECT_GT(c.Y[H], 0);
}

TEST(Reactor, TellsWhereItFails) {
  Reactor reactor(hydrogen(), {});
  Cell c = cell(1000);
  c.Y[H] = std::nan("");
  try {
    reactor.advance(c.rho, c.energy, c.Y.data(), 1e-6);
    FAIL() << "no failure";
  } catch (const PhysicsError& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("the chemistry of a cell with T ="));
    EXPECT_THAT(error.what(), ::testing::HasSubstr("O2 0.226354"));
  }
  Cell good = cell(1500);
  EXPECT_GT(reactor.advance(good.rho, good.energy, good.Y.data(), 1e-6).steps, 0);
}

TEST(Reactor, RefusesTolerancesThatAreNotPositive) {
  EXPECT_THROW(Reactor(hydrogen(), {0, 1e-6, 1e-12}), InputError);
}

}  // namespace
}  // namespace sluice::kinetics::reactor_test
