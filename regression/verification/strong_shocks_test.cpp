// Noh, Sedov, explosion, interacting blasts: plateau, shock position, order.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "exact/sedov.hpp"
#include "framework/base/exact_sum.hpp"
#include "verification/case_run.hpp"

namespace sluice::verification {
namespace {

TEST(StrongShocks, NohPlateauAtMachTenThousand) {
  constexpr double plateau = 4, allowed = .02, allowed_drift = 1e-12;
  const CaseRun run("noh_1d");
  const CellValues rho = run.field("rho_CC");
  ExactSum sum;
  int count = 0;
  for (int i = 0; i < rho.size.x; ++i) {
    const double x = std::abs(rho.centre(i).x);
    if (x > .18) continue;  // within two cells of the shock at 0.2 on
    sum.add(rho.at(i));
    ++count;
    // Wall heating leaves a notch at the middle; everywhere else each cell counts.
    if (x > .05) {
      EXPECT_NEAR(rho.at(i), plateau, allowed * plateau) << x;
    }
  }
  EXPECT_NEAR(sum.value() / count, plateau, allowed * plateau);
  EXPECT_LE(run.worst_drift(), allowed_drift);
}

// Where the density first rises above the mean of the undisturbed gas and the peak, coming from
// outside along +x.
double shock_position(const CellValues& rho, double ahead, int j) {
  double peak = 0;
  for (int i = 0; i < rho.size.x; ++i) peak = std::max(peak, rho.at(i, j));
  const double middle = .5 * (ahead + peak);
  for (int i = rho.size.x - 2; i > 0; --i) {
    if (rho.at(i, j) < middle) continue;
    const double part = (rho.at(i, j) - middle) / (rho.at(i, j) - rho.at(i + 1, j));
    return rho.centre(i, j).x + part * rho.spacing.x;
  }
  return 0;
}

TEST(StrongShocks, SedovShockStandsWhereItShould) {
  constexpr double least_order = .8;
  const CaseRun coarse("sedov", {resolution(64, 64)}), fine("sedov", {resolution(128, 128)});
  exact::Sedov::Blast blast;
  blast.dimension = 2;
  const double radius = exact::Sedov(blast).shock_radius(.15);
  const CellValues rho = fine.field("rho_CC");
  // The row next to the axis lies half a cell off it.
  const double y = rho.centre(0, 64).y;
  const double found = std::hypot(shock_position(rho, 1, 64), y);
  RecordProperty("cells_off", std::to_string((found - radius) / rho.spacing.x));
  EXPECT_NEAR(found, radius, rho.spacing.x);
  const double observed = std::log2(coarse.error("rho_CC").l1 / fine.error("rho_CC").l1);
  RecordProperty("order", std::to_string(observed));
  EXPECT_GE(observed, least_order);
  EXPECT_GT(lowest(rho), 0);
  EXPECT_GT(lowest(fine.field("press_CC")), 0);
}

TEST(StrongShocks, ExplosionFollowsTheRadialReference) {
  constexpr double least_order = .8;
  const CaseRun coarse("explosion_2d", {resolution(64, 64)});
  const CaseRun fine("explosion_2d", {resolution(128, 128)});
  const double observed = std::log2(coarse.error("rho_CC").l1 / fine.error("rho_CC").l1);
  RecordProperty("order", std::to_string(observed));
  EXPECT_GE(observed, least_order);
}

TEST(StrongShocks, InteractingBlastsFollowTheReference) {
  constexpr double least_order = .8;
  const CaseRun coarse("woodward_colella", {resolution(200)});
  const CaseRun fine("woodward_colella", {resolution(800)});
  const double observed = .5 * std::log2(coarse.error("rho_CC").l1 / fine.error("rho_CC").l1);
  RecordProperty("order", std::to_string(observed));
  EXPECT_GE(observed, least_order);
  EXPECT_GT(highest(fine.field("rho_CC")), 5.8);  // peak of 6.4 in the reference
}

}  // namespace
}  // namespace sluice::verification
