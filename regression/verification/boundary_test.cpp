// Walls, inlets and gravity: what passes a boundary, and what must not.
#include <gtest/gtest.h>

#include <cmath>

#include "verification/case_run.hpp"

namespace sluice::verification {
namespace {

constexpr double allowed_drift = 1e-13;      // of sum |q|; measured 4e-16
constexpr double allowed_in_fall = 1e-12;    // measured 6e-16
constexpr double allowed_by_sweeps = 1e-12;  // measured 2e-15

double passed(const CaseRun& run, const char* quantity) {
  return run.record().at("conservation").at(quantity).at("boundary").get<double>();
}

// Not by round-off: not at all.
void expect_closed(const CaseRun& run) {
  EXPECT_EQ(passed(run, "mass of material 0"), 0.0);
  EXPECT_EQ(passed(run, "total energy"), 0.0);
  EXPECT_LE(run.worst_drift(), allowed_drift);
}

TEST(Boundary, NothingPassesWallsOfPrescribedTemperature) {
  expect_closed(CaseRun("isothermal_walls"));
  expect_closed(CaseRun("isothermal_walls", {"CFD/ICE/advection/@type=FirstOrder"}));
}

TEST(Boundary, NothingPassesWallsUnderGravity) {
  expect_closed(CaseRun("hot_gas_under_gravity"));
  expect_closed(CaseRun("hot_gas_under_gravity", {"CFD/ICE/advection/@type=FirstOrder"}));
}

TEST(Boundary, NoMassPassesWallsInTheClassicForm) {
  for (const char* deck : {"isothermal_walls", "hot_gas_under_gravity"}) {
    const CaseRun run(deck, {"CFD/ICE/scheme=classic"});
    EXPECT_EQ(passed(run, "mass of material 0"), 0.0) << deck;
  }
}

TEST(Boundary, AnInletMayEndAtAPeriodicEdge) {
  const CaseRun run("inlet_at_periodic_edge");
  EXPECT_GT(passed(run, "mass of material 0"), 0.01);
  EXPECT_LE(run.worst_drift(), allowed_drift);
}

TEST(Boundary, GravityAcrossAFlowIsExact) {
  for (const char* order : {"FirstOrder", "SecondOrder"}) {
    const CaseRun run("free_fall", {std::string("CFD/ICE/advection/@type=") + order});
    EXPECT_LE(farthest_from(run.field("vel_CC", 0), 1.0), allowed_in_fall) << order;
    EXPECT_LE(farthest_from(run.field("vel_CC", 1), -0.5), allowed_in_fall) << order;
    EXPECT_LE(farthest_from(run.field("press_CC"), 1.0), allowed_in_fall) << order;
  }
}

TEST(Boundary, ACarriedVelocityIsThatOfTheForcedSweep) {
  // A forced sweep bounds the step by its direction too: equal steps for both.
  const std::vector<std::string> steps = {"Time/delt_max=0.002"};
  const CaseRun plain("carried_velocity", steps);
  const CaseRun forced("carried_velocity", steps, {"--force-directions"});
  ASSERT_EQ(plain.steps(), forced.steps());
  for (const int component : {0, 1, 2}) {
    const CellValues a = plain.field("vel_CC", component), b = forced.field("vel_CC", component);
    for (std::size_t n = 0; n < a.values.size(); ++n)
      EXPECT_NEAR(a.values[n], b.values[n], allowed_by_sweeps) << component << " " << n;
  }
  const CellValues a = plain.field("rho_CC"), b = forced.field("rho_CC");
  for (std::size_t n = 0; n < a.values.size(); ++n)
    EXPECT_NEAR(a.values[n], b.values[n], allowed_by_sweeps) << n;
}

// Largest deviation from the pressure far away after everything has left, as a share of the largest
// there was.
double left_over(const CaseRun& run, double height) {
  constexpr double far_away = 1 / 1.4;
  return farthest_from(run.field("press_CC"), far_away) / height;
}

TEST(OpenBoundary, APulseOfSoundLeaves) {
  const CaseRun run("pulse_leaving");
  const double share = left_over(run, 0.5 * 0.01 / 1.4);  // each half
  record("share of a pulse that comes back", share);
  EXPECT_LE(share, 0.01);  // measured 0.006, as the pull to the pressure far away must
  EXPECT_LE(run.worst_drift(), allowed_drift);
}

// What comes in at x+ is the pull to the pressure far away: sigma/2 c (1 - M^2)(p - p_inf)/L.
TEST(OpenBoundary, SavedWavesAreThoseOfItsGhosts) {
  const CaseRun run("pulse_leaving");
  const CellValues wave = run.field("Li1");
  const int last = wave.size.x - 1;
  const double c = run.field("speedSound_CC").at(last), u = run.field("vel_CC").at(last);
  const double pull = 0.5 * 0.27 * (c - u * u / c) * (run.field("press_CC").at(last) - 1 / 1.4);
  EXPECT_GT(std::abs(pull), 1e-7);
  EXPECT_NEAR(wave.at(last), pull, 1e-5 * std::abs(pull));
  for (int i = 1; i < last; ++i) EXPECT_EQ(wave.at(i), 0.0);
}

TEST(OpenBoundary, AVortexLeaves) {
  const CaseRun run("vortex_leaving");
  const double share = left_over(run, farthest_from(run.field("press_CC", 0, "first"), 1 / 1.4));
  record("share of a vortex that comes back", share);
  EXPECT_LE(share, 0.01);  // measured 0.0074
  EXPECT_LE(run.worst_drift(), allowed_drift);
}

TEST(OpenBoundary, DoesNotShowTheBoxes) {
  const std::vector<std::string> early = {"Time/maxTime=2"};
  const CaseRun one("vortex_leaving", early);
  const CaseRun many("vortex_leaving", {early[0], "Grid/Level/Box/patches=[3,4,1]"});
  EXPECT_EQ(one.field("press_CC").values, many.field("press_CC").values);
}

}  // namespace
}  // namespace sluice::verification
