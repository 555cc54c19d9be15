// A gas whose properties follow from a scalar.
#include "ice/fluid/mixed_gas.hpp"

#include <gtest/gtest.h>

#include "ice/test_support/scalars.hpp"

namespace sluice::ice::mixed_gas_test {
namespace {

// Helium in air, in units in which air has R = 1.
constexpr double cv_A = 2.5, R_A = 1, cv_B = 10.9, R_B = 7.25;

models::MixedGas two_gases() {
  models::MixedGas gas;
  gas.set_nodes({{0, cv_A, R_A}, {1, cv_B, R_B}});
  return gas;
}

std::string binary_model(const std::string& region, double cv = cv_B, double R = R_B) {
  return fmt::format(
      "<Model type='BinaryProperties'><BinaryProperties><material>gas</material><scalar name='f'>"
      "<constants><cv_A>{}</cv_A><cv_B>{}</cv_B><R_A>{}</R_A><R_B>{}</R_B></constants>"
      "<geom_object><box><min>[-99,-99,-99]</min><max>[99,99,99]</max></box><scalar>0</scalar>"
      "</geom_object>{}</scalar></BinaryProperties></Model>",
      cv_A, cv, R_A, R, region);
}

double pressure(ScalarRun& run, IntVec3 c) {
  return (two_gases().gamma(run.scalar("f", c)) - 1) * run.energy(c);
}

TEST(BinaryGas, MixesByMass) {
  const models::MixedGas gas = two_gases();
  EXPECT_DOUBLE_EQ(gas.gamma(0), 1.4);
  EXPECT_DOUBLE_EQ(gas.gamma(1), 1 + R_B / cv_B);
  // Half of the volume each, at one pressure and temperature: the energies add up.
  const double rho_A = 1 / R_A, rho_B = 1 / R_B, f = rho_B / (rho_A + rho_B);
  const double energy = 0.5 * (rho_A * cv_A + rho_B * cv_B);
  EXPECT_NEAR((gas.gamma(f) - 1) * energy, 1.0, 1e-15);
  EXPECT_EQ(gas.highest_gamma(), gas.gamma(1));
}

// Gases of one pressure and temperature are carried without a wave. Measured in pressure: 1.1e-15;
// across the grid 7.3e-7, as at corners of a jump f alone is kept between its bounds.
TEST(BinaryGas, AreCarriedAtOnePressureAndVelocity) {
  for (const IntVec3 cells : {IntVec3{60, 1, 1}, IntVec3{30, 30, 1}}) {
    GasBox box;
    box.cells = cells;
    box.velocity[0] = "0.3";
    box.velocity[1] = cells.y > 1 ? "0.2" : "0";
    const std::string helium = "(x-0.5)^2 < 0.04 ? 1/7.25 : 1";
    box.density = cells.y > 1 ? "(y-0.5)^2 < 0.04 ? (" + helium + ") : 1" : helium;
    box.models =
        binary_model(cells.y > 1 ? box_region("[0.3,0.3,-9]", "[0.7,0.7,9]", "<scalar>1</scalar>")
                                 : box_region("[0.3,-9,-9]", "[0.7,9,9]", "<scalar>1</scalar>"));
    ScalarRun run(box);
    const double before = run.amount();
    run.steps(200);
    const double allowed = cells.y > 1 ? 2e-6 : 1e-13;
    double mixed = 0;
    for_each_cell(run.domain(), [&](IntVec3 c) {
      ASSERT_NEAR(pressure(run, c), 1.0, allowed);
      ASSERT_NEAR(run.velocity(c), 0.3, allowed);
      const double f = run.scalar("f", c);
      ASSERT_GE(f, 0.0);
      ASSERT_LE(f, 1.0);
      mixed = std::max(mixed, f * (1 - f));
    });
    EXPECT_GT(mixed, 0.01);
    EXPECT_NEAR(run.amount() / before, 1.0, 1e-14);
  }
}

// Two names for one gas: the flow of that gas.
TEST(BinaryGas, OfEqualGasesIsThatGas) {
  GasBox box;
  box.cells = {64, 1, 1};
  box.pressure = "(x-0.5)^2 < 0.02 ? 3 : 1";
  box.specific_heat = cv_A;
  GasBox plain = box;
  box.models =
      binary_model(box_region("[0.4,-9,-9]", "[0.9,9,9]", "<scalar>1</scalar>"), cv_A, R_A);
  ScalarRun a(box), b(plain);
  for (int n = 0; n < 40; ++n) {
    a.steps(1);
    b.run(a.time());
  }
  // The one bounds density at contacts more sharply than the other: a few per mille here.
  double worst = 0;
  for_each_cell(a.domain(), [&](IntVec3 c) {
    worst = std::max(worst, std::fabs(a.pressure(c) / b.pressure(c) - 1));
  });
  EXPECT_LT(worst, 0.02);
}

}  // namespace
}  // namespace sluice::ice::mixed_gas_test
