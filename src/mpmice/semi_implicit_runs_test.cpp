// Semi-implicit runs of fluid and solids together, against what must hold of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "mpmice/test_support/coupled_run.hpp"

namespace sluice::mpmice::semi_implicit_runs_test {
namespace {

double farthest(const DenseField& f, double value, int c = 0) {
  double most = 0;
  for (const double q : f.components[static_cast<std::size_t>(c)])
    most = std::max(most, std::fabs(q - value));
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

}  // namespace
}  // namespace sluice::mpmice::semi_implicit_runs_test
