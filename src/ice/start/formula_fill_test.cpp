// Formulas at the start: values at the centres, and means over cells against closed forms.
#include "ice/start/formula_fill.hpp"

#include <gtest/gtest.h>

#include "ice/test_support/fluid.hpp"

namespace sluice::ice::formula_fill_test {
namespace {

// Four cells of 1 x 0.5.
Level row() {
  Level level;
  level.spacing = {1, 0.5, 1};
  level.domain = {{0, 0, 0}, {4, 1, 1}};
  level.active = {true, true, false};
  return level;
}

PrimitiveFill filled(const FormulaFill& formula) {
  const Level level = row();
  PrimitiveFill fill;
  fill.cells = level.domain;
  for (auto* v : {&fill.density, &fill.temperature, &fill.pressure}) v->assign(4, 1.0);
  for (auto& v : fill.velocity) v.assign(4, 0.0);
  IceMaterial m;
  m.fluid = {eos::IdealGas{1.4, 2.5}, std::nullopt, 1.4, 2.5};
  apply_formula(formula, m, level, fill);
  return fill;
}

FormulaFill ramps(bool over_cells) {
  FormulaFill f;
  f.density = "1 + x";
  f.pressure = "2 + y";
  f.velocity[0] = "x";
  f.over_cells = over_cells;
  return f;
}

TEST(FormulaFill, TakesValuesAtTheCentres) {
  const PrimitiveFill fill = filled(ramps(false));
  EXPECT_DOUBLE_EQ(fill.density[2], 3.5);
  EXPECT_DOUBLE_EQ(fill.velocity[0][2], 2.5);
  EXPECT_DOUBLE_EQ(fill.pressure[2], 2.25);
}

TEST(FormulaFill, OverCellsHoldsMeansOfWhatIsConserved) {
  const PrimitiveFill fill = filled(ramps(true));
  // From x = 2 to 3: <rho> = 3.5, <rho x> = 2.5 + 19/3, <rho x^2> = 19/3 + 65/4.
  const double rho = 3.5, m = 2.5 + 19.0 / 3, twice_kinetic = 19.0 / 3 + 65.0 / 4;
  EXPECT_NEAR(fill.density[2], rho, 1e-14);
  EXPECT_NEAR(fill.velocity[0][2], m / rho, 1e-14);
  const double rho_e = 2.25 / 0.4 + 0.5 * (twice_kinetic - m * m / rho);
  EXPECT_NEAR(fill.pressure[2], 0.4 * rho_e, 1e-13);
  EXPECT_NEAR(fill.temperature[2], rho_e / rho / 2.5, 1e-13);
}

TEST(FormulaFill, OverCellsKeepsAGivenTemperature) {
  FormulaFill f;
  f.temperature = "3";
  f.velocity[1] = "0.1";
  f.over_cells = true;
  const PrimitiveFill fill = filled(f);
  EXPECT_NEAR(fill.temperature[1], 3, 1e-14);
  EXPECT_NEAR(fill.velocity[1][1], 0.1, 1e-15);
  EXPECT_NEAR(fill.density[1], 1, 1e-15);
}

}  // namespace
}  // namespace sluice::ice::formula_fill_test
