// What a fluid says of its state, whatever its law.
#include "ice/fluid/fluid.hpp"

#include <gtest/gtest.h>

#include "eos/eos_test_support.hpp"
#include "ice/fluid/closure_rows.hpp"
#include "ice/test_support/fluid.hpp"

namespace sluice::ice::fluid_test {
namespace {

double by_difference(const Fluid& fluid, double rho, double T) {
  const double step = 1e-3 * T;
  return (fluid.energy_from_temperature(rho, T + step) -
          fluid.energy_from_temperature(rho, T - step)) /
         (2.0 * step * rho);
}

TEST(HeatCapacity, IsTheSlopeOfTheEnergyForEveryLaw) {
  constexpr double p = 1e7, T = 300.0;
  for (const eos::EquationOfState& law : eos::one_of_each()) {
    const Fluid fluid{law, std::nullopt, 1.4, 1000.0};
    SCOPED_TRACE(law.index());
    const double rho = fluid.density(p, T), slope = by_difference(fluid, rho, T);
    EXPECT_NEAR(fluid.heat_capacity(rho, fluid.energy_from_temperature(rho, T)), slope,
                1e-5 * slope);
  }
}

TEST(HeatCapacity, IsThatOfTheDeckWhereTheLawTakesAny) {
  Fluid fluid = stiffened_gas(4.4, 6e8);
  fluid.heat = eos::DebyeHeat{.atoms_per_mass = 9.48e24, .debye_temperature = 343.0};  // copper's
  for (const double T : {50.0, 150.0, 300.0, 900.0}) {
    const double rho = fluid.density(1e6, T), slope = by_difference(fluid, rho, T);
    EXPECT_NEAR(fluid.heat_capacity(rho, fluid.energy_from_temperature(rho, T)), slope,
                1e-5 * slope);
  }
}

// Of the vapour of a weak liquid the heat is far below the round-off of its energy.
TEST(HeatCapacity, OfNextToNothingIsThatOfTheLaw) {
  const Fluid liquid = stiffened_gas(3.0, 1e6);
  for (const double rho : {1e-20, 1e-60, 1e-180})
    EXPECT_EQ(liquid.heat_capacity(rho, liquid.energy_from_temperature(rho, 300.0)), 1000.0);
}

// Water may contract when heated: its pressure then falls with energy.
TEST(EnergyScale, IsAboveZeroWhateverHeatDoesToTheDensity) {
  for (const double a : {-0.15, 0.18}) {
    eos::KnaussSeaWater water;
    water.a = a;
    const Fluid fluid{water, std::nullopt, 1.0, water.specific_heat};
    const double rho = fluid.density(1e5, 290.0), E = fluid.energy_from_temperature(rho, 290.0);
    double scale = 0;
    energy_scale_row(fluid, 1, &rho, &E, &scale);
    EXPECT_GT(scale, 0.0) << a;
  }
}

}  // namespace
}  // namespace sluice::ice::fluid_test
