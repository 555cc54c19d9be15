// Semi-implicit runs of fluid and solids together, against what must hold of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "mpmice/test_support/coupled_run.hpp"

namespace sluice::mpmice::semi_implicit_runs_test {
namespace {

double farthest(const DenseField& f, double value, int c = 0) {
  double most = 0;
  for (const double q : f.components[c]) most = std::max(most, std::fabs(q - value));
  return most;
}

// Measured: 2e-14 of pressure and temperature.
TEST(SemiImplicitRuns, SolidAndGasThatMoveTogetherFeelNothing) {
  const CoupledRun run("implicit_moving_with_gas");
  EXPECT_EQ(run.report().status, RunStatus::done);
  EXPECT_LT(farthest(run.field("press_CC", 0), 1e5), 1e-10 * 1e5);
  EXPECT_LT(farthest(run.field("temp_CC", 1), 300), 1e-10 * 300);
  EXPECT_LT(farthest(run.field("vel_CC", 1), 100, 0), 1e-9);
  EXPECT_LT(farthest(run.field("vel_CC", 1), -37.3, 1), 1e-9);
}

// A loose solver costs accuracy, not conservation. Measured: 1e-16 in both.
TEST(SemiImplicitRuns, MassAndMomentumDoNotDependOnTheTolerance) {
  const std::string solver = "CFD/ICE/ImplicitSolver/";
  for (const char* tolerance : {"1e-2", "1e-12"}) {
    const CoupledRun run("implicit_thrown_disk",
                         {solver + "Parameters/tolerance=" + tolerance,
                          solver + "max_outer_iterations=1", "Time/maxTime=0.0005"});
    ASSERT_EQ(run.report().status, RunStatus::done) << tolerance;
    EXPECT_LT(run.worst_drift_but_energy(), 1e-12) << tolerance;
  }
}

// Sound crosses 5, 10 and 50 cells in a step. Pressures were 1e5 and 1.1e5 at the start.
TEST(SemiImplicitRuns, APulseBesideABodyStaysBoundedAtAnyCourantNumber) {
  for (const char* step : {"3.6e-4", "7e-4", "3.6e-3"}) {
    const CoupledRun run("implicit_pulse_beside_body", {std::string("Time/delt_max=") + step});
    ASSERT_EQ(run.report().status, RunStatus::done) << step;
    EXPECT_LT(farthest(run.field("press_CC", 0), 1.0e5), 2e3) << step;
    EXPECT_LT(farthest(run.field("vel_CC", 1), 0, 0), 4.0) << step;
    EXPECT_LT(farthest(run.field("vel_CC", 1), 0, 1), 4.0) << step;
    EXPECT_LT(std::fabs(run.drift("mass of material 1")), 1e-14) << step;
  }
}

// Boxes and threads, with our own solver.
TEST(SemiImplicitRuns, SameBitsOnBoxesAndThreads) {
  const std::vector<std::string> shorter = {"Time/maxTime=0.0003"};
  const CoupledRun one("implicit_thrown_disk", shorter);
  const CoupledRun many("implicit_thrown_disk", shorter, 2, {3, 2, 1});
  for (const auto& [label, material] : {std::pair{"press_CC", 0}, {"temp_CC", 1}, {"vel_CC", 1}})
    EXPECT_EQ(one.field(label, material).components, many.field(label, material).components)
        << label;
}

// The solid on the finer of two levels, which share one system.
TEST(SemiImplicitRuns, KeepMassAndMomentumOnLevels) {
  CoupledDeck deck;
  deck.time = "0.0005";
  deck.solid = solid_object(disk_at(0.4, 0.5, 0.15), "[30,10,0]");
  deck.fluid =
      "<ImplicitSolver><max_outer_iterations>1</max_outer_iterations><outer_iteration_tolerance>"
      "1e-6</outer_iteration_tolerance><Parameters variable='implicitPressure'>"
      "<tolerance>1e-2</tolerance></Parameters></ImplicitSolver>";
  deck.periodic = "[1,1,0]";
  deck.finer =
      "<Level><Box label='2'><lower>[0.1,0.2,0]</lower><upper>[0.7,0.8,0.025]</upper>"
      "<resolution>[48,48,1]</resolution></Box></Level>";
  const CoupledRun run(deck);
  ASSERT_EQ(run.report().status, RunStatus::done);
  EXPECT_LT(run.worst_drift_but_energy(), 1e-12);
}

// The disk at rest where the gases move: it is thrown into them.
const std::string disk_at_rest = "MaterialProperties/MPM/material/geom_object/velocity=[0,0,0]";

// Measured: 5e-14 of the pressure, 3e-12 m/s.
TEST(SemiImplicitRuns, SolidAndTwoGasesThatMoveTogetherFeelNothing) {
  const CoupledRun run("implicit_disk_in_two_gases");
  EXPECT_EQ(run.report().status, RunStatus::done);
  EXPECT_LT(farthest(run.field("press_CC", 0), 1e5), 1e-10 * 1e5);
  EXPECT_LT(farthest(run.field("vel_CC", 1), 100, 0), 1e-9);
  EXPECT_LT(farthest(run.field("vel_CC", 1), -37.3, 1), 1e-9);
  EXPECT_LT(run.worst_drift_but_energy(), 1e-12);
}

// Measured: 2e-16 in both.
TEST(SemiImplicitRuns, MassOfEachFluidAndMomentumDoNotDependOnTheTolerance) {
  const std::string solver = "CFD/ICE/ImplicitSolver/";
  for (const char* tolerance : {"1e-2", "1e-12"}) {
    const CoupledRun run("implicit_disk_in_two_gases",
                         {disk_at_rest, solver + "Parameters/tolerance=" + tolerance,
                          solver + "max_outer_iterations=1", "Time/maxTime=0.0005"});
    ASSERT_EQ(run.report().status, RunStatus::done) << tolerance;
    EXPECT_LT(run.worst_drift_but_energy(), 1e-12) << tolerance;
  }
}

TEST(SemiImplicitRuns, SeveralFluidsHaveTheSameBitsOnBoxesAndThreads) {
  const std::vector<std::string> thrown = {disk_at_rest, "Time/maxTime=0.0003"};
  const CoupledRun one("implicit_disk_in_two_gases", thrown);
  const CoupledRun many("implicit_disk_in_two_gases", thrown, 2, {3, 2, 1});
  for (const auto& [label, material] : {std::pair{"press_CC", 0}, {"temp_CC", 1}, {"vel_CC", 2}})
    EXPECT_EQ(one.field(label, material).components, many.field(label, material).components)
        << label;
}

// Gas between two plates, a sixth of one cell all of whose faces are covered, squeezed to two
// thirds: its pressure follows in each step, along its isentrope.
TEST(SemiImplicitRuns, AClosedPocketTakesItsPressureAtOnce) {
  CoupledDeck deck;
  deck.cells = "[20,1,1]";
  deck.upper = "[1,0.05,0.05]";
  deck.density = "1000";
  deck.bulk = "1e8";
  deck.shear = "6e7";
  deck.solid = solid_object(box_from("[0.2,-1,-1]", "[0.512,1,1]"), "[5,0,0]");
  deck.further =
      solid_of(deck, "other", solid_object(box_from("[0.52,-1,-1]", "[0.8,1,1]"), "[-5,0,0]"));
  deck.drag = "0,0,0";
  deck.heat = "0,0,0";
  deck.time = "0.0003";
  deck.fluid =
      "<ImplicitSolver><max_outer_iterations>5</max_outer_iterations>"
      "<outer_iteration_tolerance>1e-8</outer_iteration_tolerance></ImplicitSolver>";
  const CoupledRun run(deck);
  ASSERT_EQ(run.report().status, RunStatus::done) << run.report().message;
  EXPECT_EQ(run.report().events_json.find("redone"), std::string::npos) << run.report().events_json;
  const double p = run.field("press_CC", 0).components[0][10];
  const double rho = run.field("rho_CC", 2).components[0][10];
  EXPECT_GT(p, 1.5e5);
  EXPECT_NEAR(p / 1e5, std::pow(rho / (1e5 / (0.4 * 717.5 * 300)), 1.4), 0.01 * p / 1e5);
}

}  // namespace
}  // namespace sluice::mpmice::semi_implicit_runs_test
