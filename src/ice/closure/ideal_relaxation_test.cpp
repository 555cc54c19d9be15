// Rows of cells of ideal gases against the cell rule for any law, and what must be kept.
#include "ice/closure/ideal_relaxation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "ice/closure/equilibrate.hpp"
#include "ice/test_support/mixture.hpp"

namespace sluice::ice::mixture::ideal_relaxation_test {
namespace {

constexpr int cells = IdealRelaxation::max_cells;

struct Cells {
  double M[3][cells], V[3][cells], E[3][cells];
  double pressure[cells], modulus[cells];

  bool relax(const IdealRelaxation& rule) {
    GasRows rows[3];
    for (int m = 0; m < 3; ++m) rows[m] = {M[m], V[m], E[m]};
    return rule.relax(cells, rows, pressure, modulus);
  }
  double energy(int i) const { return E[0][i] + E[1][i] + E[2][i]; }
};

// Every set of one to three gases, from traces to halves, pressures apart by up to a factor of 10.
Cells any_cells() {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  Cells c{};
  for (int i = 0; i < cells; ++i) {
    double sum = 0;
    for (int m = 0; m < 3; ++m) {
      if (((i % 7 + 1) >> m & 1) == 0) continue;
      sum += c.V[m][i] = std::pow(10.0, -12.0 * (i % 5 == m) * unit(random)) * (unit(random) + .1);
    }
    for (int m = 0; m < 3; ++m) {
      c.V[m][i] /= sum;
      c.M[m][i] = c.V[m][i] * (1.0 + m);
      c.E[m][i] = c.V[m][i] * 1e5 * std::pow(10.0, unit(random));
    }
  }
  return c;
}

const std::vector<Fluid>& gases() {
  static const std::vector<Fluid> three{ideal_gas(1.4, 717), ideal_gas(1.667, 300),
                                        ideal_gas(1.1, 1000)};
  return three;
}

TEST(IdealRelaxation, AgreesWithTheRuleForAnyLaw) {
  const Cells before = any_cells();
  Cells after = before;
  ASSERT_TRUE(after.relax(IdealRelaxation(gases())));
  const Equilibration any(gases());
  for (int i = 0; i < cells; ++i) {
    double M[3], V[3], E[3];
    for (int m = 0; m < 3; ++m) {
      M[m] = before.M[m][i];
      V[m] = before.V[m][i];
      E[m] = before.E[m][i];
    }
    const auto result = any.equilibrate({M, V, E});
    ASSERT_EQ(result.failed, -1);
    EXPECT_NEAR(after.pressure[i], result.pressure, 1e-14 * result.pressure);
    EXPECT_NEAR(after.modulus[i], result.modulus, 1e-14 * result.modulus);
    for (int m = 0; m < 3; ++m) {
      EXPECT_NEAR(after.V[m][i], V[m], 1e-14);
      EXPECT_NEAR(after.E[m][i], E[m], 1e-14 * before.energy(i));
    }
  }
}

TEST(IdealRelaxation, KeepsVolumeEnergyAndWhatIsInEquilibrium) {
  const IdealRelaxation rule(gases());
  Cells c = any_cells();
  const Cells before = c;
  ASSERT_TRUE(c.relax(rule));
  const Cells once = c;
  ASSERT_TRUE(c.relax(rule));
  for (int i = 0; i < cells; ++i) {
    EXPECT_DOUBLE_EQ(once.V[0][i] + once.V[1][i] + once.V[2][i], 1.0);
    EXPECT_NEAR(once.energy(i), before.energy(i), 4e-16 * before.energy(i));
    for (int m = 0; m < 3; ++m) {
      // The rest may go to another gas, by round-off of the sum.
      EXPECT_NEAR(c.V[m][i], once.V[m][i], 2e-16);
      EXPECT_EQ(c.E[m][i], once.E[m][i]);
      EXPECT_EQ(once.V[m][i] == 0.0, before.M[m][i] == 0.0);
    }
  }
}

TEST(IdealRelaxation, AGasWithoutAStateStopsTheRowAndNothingChanges) {
  const IdealRelaxation rule(gases());
  Cells c = any_cells();
  c.E[0][9] = -1.0;
  c.M[0][9] = c.V[0][9] = 0.1;
  const Cells before = c;
  EXPECT_FALSE(c.relax(rule));
  for (int m = 0; m < 3; ++m)
    for (int i = 0; i < cells; ++i) {
      EXPECT_EQ(c.V[m][i], before.V[m][i]);
      EXPECT_EQ(c.E[m][i], before.E[m][i]);
    }
}

TEST(IdealRelaxation, IsForIdealGasesAlone) {
  EXPECT_TRUE(IdealRelaxation(gases()).applies());
  EXPECT_FALSE(IdealRelaxation({ideal_gas(1.4, 717), stiffened_gas(4.4, 6e8)}).applies());
}

}  // namespace
}  // namespace sluice::ice::mixture::ideal_relaxation_test
