// Mass, momentum and total energy with shocks that levels follow, through regrids and restarts.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "verification/amr_case.hpp"

namespace sluice::verification::amr_conservation_test {
namespace {

// Of sum |q|, per 1,000 steps. Measured: at most 1.3e-16, 3.2e-14 in gravity.
constexpr double allowed_drift = 1e-13;

double drift_per_thousand(const CaseRun& run) {
  const double steps = run.record().at("last_step").get<double>();
  const double drift = run.worst_drift() / std::max(1., steps / 1000);
  record("drift", drift);
  return drift;
}

// A run that can be gone on with from its end.
CaseRun begin(const std::string& deck, std::vector<std::string> overrides, int steps) {
  overrides.emplace_back("DataArchiver/checkpoint/@timestepInterval=100000");
  overrides.emplace_back("DataArchiver/checkpoint/@lastTimestep=true");
  return CaseRun(deck, overrides, {"--max-steps", std::to_string(steps)});
}

// Goes on from where the other stopped.
CaseRun go_on(const CaseRun& from, std::vector<std::string> options = {}) {
  options.insert(options.begin(), {"--restart", from.archive().string()});
  return CaseRun((from.archive() / "input.xml").string(), {}, options);
}

TEST(AmrConservation, PeriodicTubeThroughRestarts) {
  const CaseRun first =
      begin("amr_periodic_shocks", {"Time/maxTime=10", "DataArchiver/outputInterval=10"}, 301);
  const CaseRun second = go_on(first, {"--max-steps", "602"}), last = go_on(second);
  EXPECT_GE(last.record().at("last_step").get<int>(), 1000);
  EXPECT_GE(regrids(first) + regrids(second) + regrids(last), 300);
  EXPECT_EQ(max_cells(last).size(), 3u);
  EXPECT_LT(share_of_uniform(last), .9);
  EXPECT_LE(drift_per_thousand(last), allowed_drift);
}

TEST(AmrConservation, PeriodicTubeInLockstep) {
  const CaseRun run("amr_periodic_shocks", {"Time/maxTime=1", "AMR/useLockStep=true"});
  EXPECT_GE(run.steps(), 500);
  EXPECT_LE(drift_per_thousand(run), allowed_drift);
}

// The classic form matches fluxes unless the deck forbids it.
TEST(AmrConservation, ClassicFormLosesMassOnlyWhereTheDeckLeavesFluxesUnequal) {
  constexpr double least_loss = 1e-5;  // 4.0e-4; with matched fluxes 6.9e-17
  const auto mass_drift = [](const char* matched) {
    const CaseRun run("amr_periodic_shocks", {"CFD/ICE/scheme=classic", "Time/maxTime=0.2",
                                              std::string("AMR/ICE/do_Refluxing=") + matched});
    return std::abs(run.record()["conservation"]["mass of material 0"]["drift"].get<double>());
  };
  EXPECT_LE(mass_drift("true"), allowed_drift);
  EXPECT_GE(mass_drift("false"), least_loss);
}

TEST(AmrConservation, OpenTubeThatTheShockLeaves) {
  const CaseRun run("amr_shock_tube", {"Time/maxTime=0.6", "DataArchiver/outputInterval=0.6"});
  EXPECT_LE(drift_per_thousand(run), allowed_drift);
}

TEST(AmrConservation, ClosedSquareThroughARestart) {
  const CaseRun first =
      begin("amr_blast_3d",
            {resolution(32, 32), "Time/maxTime=0.1", "DataArchiver/outputInterval=0.1",
             "CFD/ICE/customInitialization/formula/pressure=x^2 + y^2 < 0.015 ? 1000 : 0.01"},
            40);
  const CaseRun last = go_on(first);
  EXPECT_GE(regrids(first), 5);
  EXPECT_LE(drift_per_thousand(last), allowed_drift);
  const std::vector<LevelCell> pressure = level_cells(last, "press_CC");
  EXPECT_TRUE(std::all_of(pressure.begin(), pressure.end(),
                          [](const LevelCell& cell) { return cell.value > 0; }));
}

TEST(AmrConservation, ClosedCube) {
  const CaseRun run("amr_blast_3d", {resolution(16, 16, 16), threshold(1, 200)},
                    {"--threads", "2"});
  EXPECT_LE(drift_per_thousand(run), allowed_drift);
}

// Shocks that run through a fixed region, reflected by walls that both levels share.
void expect_a_closed_tube_to_keep(const std::string& time) {
  const CaseRun run("amr_hydrostatic_column",
                    {"PhysicalConstants/gravity=[0,0,0]", "Time/maxTime=" + time,
                     "DataArchiver/outputInterval=" + time,
                     "CFD/ICE/customInitialization/formula/pressure=x^2 + y^2 < 0.09 ? 1e7 : 1e5"});
  EXPECT_LE(drift_per_thousand(run), allowed_drift);
}
TEST(AmrConservation, ClosedTubeWithAFixedRegion) {
  expect_a_closed_tube_to_keep("0.0005");
}
TEST(FullAmrConservation, ClosedTubeWithAFixedRegion) {
  expect_a_closed_tube_to_keep("0.002");
}

// Walls and gravity act on both levels; what they do is counted.
void expect_a_closed_box_to_keep(const std::string& time) {
  const CaseRun run("amr_hydrostatic_column",
                    {"Time/maxTime=" + time, "DataArchiver/outputInterval=" + time,
                     "CFD/ICE/customInitialization/formula/density=x^2 + y^2 < 0.09 ? 12 : 1.2"});
  EXPECT_LE(drift_per_thousand(run), allowed_drift);
  EXPECT_GT(std::abs(run.record()["conservation"]["total energy"]["sources"].get<double>()), 0);
}
TEST(AmrConservation, ClosedBoxInGravity) {
  expect_a_closed_box_to_keep("0.003");
}
TEST(FullAmrConservation, ClosedBoxInGravity) {
  expect_a_closed_box_to_keep("0.015");
}

// Round-off sets gas at rest in no direction: what has no cause is measured by the sound speed.
void expect_a_column_at_rest(const std::string& steps) {
  constexpr double limit = 1e-10;  // of the sound speed; 1.1e-15
  const double sound_speed = std::sqrt(1.4 * 101325 / 1.2);
  const CaseRun run("amr_hydrostatic_column", {"Time/maxTime=1", "DataArchiver/outputInterval=1"},
                    {"--max-steps", steps});
  const double share =
      std::max(farthest_on_levels(run, "vel_CC", 0, 0), farthest_on_levels(run, "vel_CC", 1, 0)) /
      sound_speed;
  record("share", share);
  EXPECT_LE(share, limit);
}
TEST(AmrConservation, ColumnStaysAtRestOnThreeLevels) {
  expect_a_column_at_rest("60");
}
TEST(FullAmrConservation, ColumnStaysAtRestOnThreeLevels) {
  expect_a_column_at_rest("200");
}

}  // namespace
}  // namespace sluice::verification::amr_conservation_test
