// Noh, Sedov, explosion, interacting blasts: plateau, shock position, order.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "exact/radial/radial_euler.hpp"
#include "exact/radial/sedov.hpp"
#include "framework/base/exact_sum.hpp"
#include "verification/case_run.hpp"

namespace sluice::verification::strong_shocks_test {
namespace {

TEST(StrongShocks, NohPlateauAtMachTenThousand) {
  constexpr double plateau = 4, allowed = .02;  // mean 3.989
  constexpr double allowed_drift = 1e-12;       // 1.6e-16
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
  record("plateau", sum.value() / count);
  record("drift", run.worst_drift());
  EXPECT_LE(run.worst_drift(), allowed_drift);
}

// Where a row of cells first reaches the level, coming from its high end in x; linear between the
// centres.
double crossing_from_right(const CellValues& field, double level, int j = 0) {
  for (int i = field.size.x - 2; i >= 0; --i) {
    if (field.at(i, j) < level) continue;
    const double part = (field.at(i, j) - level) / (field.at(i, j) - field.at(i + 1, j));
    return field.centre(i, j).x + part * field.spacing.x;
  }
  return HUGE_VAL;
}

double crossing_from_left(const CellValues& field, double level) {
  for (int i = 1; i < field.size.x; ++i) {
    if (field.at(i) < level) continue;
    const double part = (field.at(i) - level) / (field.at(i) - field.at(i - 1));
    return field.centre(i).x - part * field.spacing.x;
  }
  return HUGE_VAL;
}

// The order at which the error fell from one run to another with `ratio` times the cells in a row.
double order(const CaseRun& coarse, const CaseRun& fine, double ratio) {
  return std::log(coarse.error("rho_CC").l1 / fine.error("rho_CC").l1) / std::log(ratio);
}

// The reference starts from the same deposit of energy; the shock itself is Sedov's own.
TEST(FullStrongShocks, SedovShockStandsWhereItShould) {
  constexpr double min_order = .9;  // 0.908; 0.74 cells ahead
  const CaseRun coarse("sedov", {resolution(128, 128)}), fine("sedov", {resolution(256, 256)});
  exact::Sedov::Blast blast;
  blast.dimension = 2;
  const exact::Sedov solution(blast);
  const double radius = solution.shock_radius(.15), speed = solution.shock_speed(.15);
  // The front: where the pressure first reaches half of what a strong shock of this speed makes.
  const double level = .5 * 2 / 2.4 * speed * speed;
  const CellValues p = fine.field("press_CC");
  // Along the axis, where grid-aligned fronts run ahead most; the row lies half a cell off it.
  const double along_axis = std::hypot(crossing_from_right(p, level), .5 * p.spacing.y);
  record("cells_off", (along_axis - radius) / p.spacing.x);
  EXPECT_NEAR(along_axis, radius, p.spacing.x);
  const double observed = order(coarse, fine, 2);
  record("order", observed);
  EXPECT_GE(observed, min_order);
  EXPECT_GT(lowest(fine.field("rho_CC")), 0);
  EXPECT_GT(lowest(p), 0);
  const CellValues rho = fine.field("rho_CC");
  for (int j = 0; j < 256; ++j) {
    for (int i = 0; i < j; ++i) ASSERT_EQ(rho.at(i, j), rho.at(j, i)) << i << ' ' << j;
  }
}

TEST(FullStrongShocks, ExplosionFollowsTheRadialReference) {
  constexpr double min_order = .9;  // 0.904; 0.17 cells ahead
  const CaseRun coarse("explosion_2d", {resolution(64, 64)});
  const CaseRun fine("explosion_2d", {resolution(256, 256)});
  const double observed = order(coarse, fine, 4);
  record("order", observed);
  EXPECT_GE(observed, min_order);
  const CellValues p = fine.field("press_CC"), wanted = fine.exact_field(p, "press_CC");
  const double level = .17;  // 0.1 ahead of the shock, 0.243 behind it
  const double off = crossing_from_right(p, level, 128) - crossing_from_right(wanted, level, 128);
  record("cells_off", off / p.spacing.x);
  EXPECT_LE(std::abs(off), p.spacing.x);
}

// What a second-order Godunov code that captures everything makes of the blasts on as many cells.
double godunov_error(const CaseRun& like) {
  exact::RadialProblem problem;
  problem.pieces = {{.1, 1, 0, 1000}, {.9, 1, 0, .01}, {1, 1, 0, 100}};
  const CellValues cells = like.field("rho_CC");
  const CellValues wanted = like.exact_field(cells, "rho_CC");
  problem.cells = cells.size.x;
  exact::RadialEuler run(problem);
  run.advance_to(cells.time);
  ExactSum sum;
  for (int i = 0; i < cells.size.x; ++i) {
    sum.add(std::abs(run.at(cells.centre(i).x).density - wanted.at(i)));
  }
  return sum.value() / cells.size.x;
}

// Three captured contacts spread as N^(-2/3) to N^(-3/4), and hold the order below 1: what is asked
// is to be better than a Godunov code, at both resolutions and in order.
TEST(FullStrongShocks, InteractingBlastsFollowTheReference) {
  constexpr double min_order = .8;  // 0.848, Godunov 0.813; 0.67 cells behind, 0.35 ahead
  const CaseRun coarse("woodward_colella", {resolution(200)});
  const CaseRun fine("woodward_colella", {resolution(800)});
  const auto error = [](const CaseRun& run) { return run.error_at_centres("rho_CC").l1; };
  const double observed = .5 * std::log2(error(coarse) / error(fine));
  record("order", observed);
  EXPECT_GE(observed, min_order);
  const double coarse_godunov = godunov_error(coarse), fine_godunov = godunov_error(fine);
  const double godunov_order = .5 * std::log2(coarse_godunov / fine_godunov);
  record("godunov_order", godunov_order);
  record("share_of_godunov_error", error(fine) / fine_godunov);
  EXPECT_GE(observed, godunov_order);
  EXPECT_LE(error(coarse), coarse_godunov);
  EXPECT_LE(error(fine), fine_godunov);
  const CellValues p = fine.field("press_CC"), wanted = fine.exact_field(p, "press_CC");
  // The shocks that have met: pressure 115 to 411 at 0.65, 108 to 19 at 0.87.
  const double left = crossing_from_left(p, 250) - crossing_from_left(wanted, 250);
  const double right = crossing_from_right(p, 60) - crossing_from_right(wanted, 60);
  record("left_cells_off", left / p.spacing.x);
  record("right_cells_off", right / p.spacing.x);
  EXPECT_LE(std::abs(left), p.spacing.x);
  EXPECT_LE(std::abs(right), p.spacing.x);
  EXPECT_GT(highest(fine.field("rho_CC")), 5.8);  // 6.4 in the reference
}

}  // namespace
}  // namespace sluice::verification::strong_shocks_test
