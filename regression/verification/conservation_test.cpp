// Mass, momentum and total energy with shocks inside: closed, open and periodic boxes.
#include <gtest/gtest.h>

#include <algorithm>

#include "verification/case_run.hpp"

namespace sluice::verification::conservation_test {
namespace {

// Of sum |q|, per 1,000 steps; boundary fluxes and wall impulses counted. Measured: at most 3e-16
// in the boxes, 6.7e-15 in gravity.
constexpr double allowed_drift = 1e-13;

double drift_per_thousand(const CaseRun& run) {
  const double drift = run.worst_drift() / std::max(1., run.steps() / 1000.);
  record("drift", drift);
  return drift;
}

TEST(Conservation, ClosedTube) {
  const CaseRun run("woodward_colella");
  EXPECT_GE(run.steps(), 1000);
  EXPECT_LE(drift_per_thousand(run), allowed_drift);
}

TEST(Conservation, OpenTubeThatTheShockLeaves) {
  const CaseRun run("riemann_sod", {"Time/maxTime=0.6", "DataArchiver/outputInterval=0.6"});
  EXPECT_LE(drift_per_thousand(run), allowed_drift);
}

TEST(Conservation, PeriodicTube) {
  const CaseRun run("periodic_shocks");
  EXPECT_GE(run.steps(), 1000);
  EXPECT_LE(drift_per_thousand(run), allowed_drift);
}

TEST(Conservation, ClosedSquareWithReflectedShocks) {
  const CaseRun run("blast_2d", {resolution(64, 64)});
  EXPECT_LE(drift_per_thousand(run), allowed_drift);
  EXPECT_GT(lowest(run.field("press_CC")), 0);
}

TEST(Conservation, ClosedCube) {
  const CaseRun run("blast_3d", {resolution(24, 24, 24)});
  EXPECT_LE(drift_per_thousand(run), allowed_drift);
  EXPECT_GT(lowest(run.field("press_CC")), 0);
}

TEST(Conservation, ColumnInGravity) {
  const CaseRun run("hydrostatic_column", {}, {"--max-steps", "2000"});
  EXPECT_LE(drift_per_thousand(run), allowed_drift);
}

}  // namespace
}  // namespace sluice::verification::conservation_test
