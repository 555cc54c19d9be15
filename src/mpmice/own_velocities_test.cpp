// Fluids with velocities of their own beside solids: one velocity where a solid touches the cell,
// theirs elsewhere, and nothing is lost between the two.
#include <gtest/gtest.h>

#include <cmath>

#include "mpmice/test_support/coupled_run.hpp"

namespace sluice::mpmice::own_velocities_test {
namespace {

// Half of every cell is gas of 1.16 kg/m^3, half one of 23 kg/m^3, both at 1 bar and 300 K.
std::string half_of(double gas_constant, const std::string& velocity) {
  return fmt::format(
      "<geom_object>{}<res>[1,1,1]</res><velocity>{}</velocity><temperature>300</temperature>"
      "<density>{:.17g}</density><volumeFraction>0.5</volumeFraction></geom_object>",
      everywhere, velocity, 1e5 / (gas_constant * 300));
}

CoupledDeck two_gases(const std::string& light, const std::string& heavy, double drag) {
  CoupledDeck deck;
  deck.periodic = "[1,1,0]";
  deck.gas = half_of(287, light);
  deck.further_gas =
      "<material name='heavy'><EOS type='ideal_gas'/><dynamic_viscosity>0</dynamic_viscosity>"
      "<thermal_conductivity>0</thermal_conductivity><specific_heat>71.75</specific_heat>"
      "<gamma>1.2</gamma>" +
      half_of(14.35, heavy) + "</material>";
  deck.drag = fmt::format("0,0,{}", drag);
  deck.heat = "0,0,0";
  deck.shear = "10";
  deck.time = "0.0005";
  deck.saves = {"press_CC", "temp_CC", "vel_CC", "rho_CC", "vol_frac_CC", "p.x", "p.particleID"};
  return deck;
}

// Slip of the heavy gas against the light one in the column i, largest and smallest.
std::pair<double, double> slip(const CoupledRun& run, int i) {
  const DenseField light = run.field("vel_CC", 1), heavy = run.field("vel_CC", 2);
  double least = 1e300, most = -1e300;
  for (int j = 0; j < 40; ++j) {
    const std::size_t n = j * 40 + i;
    const double apart = heavy.components[0][n] - light.components[0][n];
    least = std::min(least, apart);
    most = std::max(most, apart);
  }
  return {least, most};
}

// Whatever the drag, and however a body runs through them. A rigid body at rest takes no energy;
// one that deforms has a defect of its own: 1.4e-3 where drag binds the gases too.
TEST(FluidsThatMoveApart, LoseNothingBesideSolids) {
  for (const double drag : {0.0, 1e4, 1e8})
    for (const bool fast : {false, true}) {
      CoupledDeck deck = two_gases("[120,0,0]", "[-6,30,0]", drag);
      const std::string disk =
          solid_object(disk_at(0.4, 0.5, 0.15), fast ? "[600,-200,0]" : "[0,0,0]");
      deck.solid = fast ? disk : "<is_rigid>true</is_rigid>" + disk;
      deck.viscosity = fast ? "0.05" : "0";
      deck.time = "0.0002";
      const CoupledRun run(deck), all(deck, {}, 1, {}, true);
      SCOPED_TRACE(fmt::format("drag {:g}, fast {}", drag, fast));
      ASSERT_EQ(run.report().status, RunStatus::done) << run.report().message;
      EXPECT_LT(run.drift("mass of material 1"), 1e-13);
      EXPECT_LT(run.drift("mass of material 2"), 1e-13);
      if (fast) {
        EXPECT_LT(run.worst_drift_but_energy(), 1e-13);
      }
      RecordProperty(fmt::format("energy_{:g}_{}", drag, fast),
                     fmt::format("{:.3e}", run.drift("total energy")));
      EXPECT_LT(std::fabs(run.drift("total energy")), fast ? 3e-3 : 1e-12);
      for (const auto& [label, material] : {std::pair{"press_CC", 0},
                                            {"temp_CC", 1},
                                            {"vel_CC", 1},
                                            {"vel_CC", 2},
                                            {"vol_frac_CC", 2}})
        EXPECT_EQ(run.field(label, material).components, all.field(label, material).components)
            << label << material;
      EXPECT_EQ(run.particles("p.x"), all.particles("p.x"));
    }
}

// A wall of particles at rest: beside it the gases have one velocity, far from it, where no sound
// has come, the exact exp(-t K V_1 V_2 (1/M_1 + 1/M_2)).
TEST(FluidsThatMoveApart, HaveOneVelocityAtWallsAndTheirsAfar) {
  const double drag = 1e4;
  CoupledDeck deck = two_gases("[12,0,0]", "[-0.6,0,0]", drag);
  deck.periodic = "[0,1,0]";
  deck.solid =
      "<is_rigid>true</is_rigid>" + solid_object(box_from("[-1,-1,-1]", "[0.3125,2,2]"), "[0,0,0]");
  const CoupledRun run(deck);
  ASSERT_EQ(run.report().status, RunStatus::done) << run.report().message;
  const double M_1 = 0.5e5 / (287 * 300), M_2 = 0.5e5 / (14.35 * 300);
  const double rate = drag * 0.25 * (1 / M_1 + 1 / M_2);
  const auto [least, most] = slip(run, 30);
  RecordProperty("slip", fmt::format("{:.6f} {:.6f}", least, most));
  EXPECT_NEAR(least, -12.6 * std::exp(-rate * run.report().time), 1e-3);
  EXPECT_NEAR(most, least, 1e-12);
  EXPECT_EQ(slip(run, 12), std::pair(0.0, 0.0));  // the face of the wall is in these cells
}

CoupledDeck thrown_between_sheared_gases(double drag) {
  CoupledDeck deck = two_gases("[120,0,0]", "[-6,30,0]", drag);
  deck.solid = solid_object(disk_at(0.4, 0.5, 0.15), "[50,-20,0]");
  deck.shear = "3e5";
  return deck;
}

// In long steps of a pressure solve; on levels; with friction, conduction and a scalar.
TEST(FluidsThatMoveApart, RunWithTheOtherEffects) {
  const std::string implicit =
      "<ImplicitSolver><max_outer_iterations>1</max_outer_iterations><outer_iteration_tolerance>"
      "1e-8</outer_iteration_tolerance><Parameters variable='implicitPressure'>"
      "<tolerance>1e-6</tolerance></Parameters></ImplicitSolver>";
  for (const bool solved : {false, true})
    for (const bool levels : {false, true}) {
      SCOPED_TRACE(fmt::format("implicit {}, levels {}", solved, levels));
      CoupledDeck deck = thrown_between_sheared_gases(1e4);
      deck.time = "0.0001";
      if (solved) deck.fluid = implicit;
      if (levels)
        deck.finer =
            "<Level><Box label='2'><lower>[0.1,0.2,0]</lower><upper>[0.7,0.8,0.025]"
            "</upper><resolution>[48,48,1]</resolution></Box></Level>";
      deck.viscosity = "0.05";
      const CoupledRun run(deck, {"MaterialProperties/ICE/material[1]/thermal_conductivity=5"});
      ASSERT_EQ(run.report().status, RunStatus::done) << run.report().message;
      EXPECT_LT(run.worst_drift_but_energy(), 1e-12);
      RecordProperty(fmt::format("energy_{}_{}", solved, levels),
                     fmt::format("{:.3e}", run.drift("total energy")));
    }
}

TEST(FluidsThatMoveApart, BoxesAndThreadsDoNotShow) {
  const CoupledDeck deck = thrown_between_sheared_gases(1e5);
  const CoupledRun one(deck), many(deck, {}, 2, {3, 2, 1});
  ASSERT_EQ(one.report().status, RunStatus::done);
  for (const int m : {1, 2})
    for (const char* label : {"vel_CC", "temp_CC", "vol_frac_CC"})
      EXPECT_EQ(one.field(label, m).components, many.field(label, m).components) << label << m;
}

}  // namespace
}  // namespace sluice::mpmice::own_velocities_test
