// The search for a solver: what it ranks meets the goal, the budget is kept, and tolerances of
// hypre's solvers meet goals that hypre does not measure.
#include "app/tune/tune_search.hpp"

#include <gtest/gtest.h>

#include "framework/solve/solve_test_support.hpp"

namespace sluice::app::tune_search_test {
namespace {

using solve::Norm;
using solve::SolverSettings;

CapturedSystems systems_of(int count) {
  solve::SystemCapture capture(static_cast<std::size_t>(count), 4);
  const auto level = solve::level_of({12, 12, 1});
  for (int n = 1; n <= count; ++n) {
    const auto solver = solve::make_linear_solver({});
    solver->set_up(solve::matrix_of(*level, {.diagonal = 0.01 * n}));
    solve::solve_from_zero(*solver, *level, solve::noisy);
    solve::solve_from_zero(*solver, *level, [](IntVec3 c) { return c.y == 2 ? 1e-3 : 0.0; });
  }
  return capture.take();
}

TEST(TuneSearch, WithoutTimeTheDecksOwnAloneIsMeasured) {
  const CapturedSystems systems = systems_of(2);
  TuneSearch search(systems, solver_candidates({}, systems), [] { return 2.0; }, 1.0, {});
  const auto ranking = search.run();
  EXPECT_EQ(short_name(ranking.front().settings), "CGSolver");
  EXPECT_EQ(ranking.front().state, TuneState::ranked);
  EXPECT_EQ(ranking.front().trials.size(), 1u);
  EXPECT_GT(ranking.size(), 20u);
  for (std::size_t n = 1; n < ranking.size(); ++n)
    EXPECT_EQ(ranking[n].state, TuneState::not_tried) << short_name(ranking[n].settings);
}

TEST(TuneSearch, WhatIsRankedMeetsTheGoalOnEverySystem) {
  const CapturedSystems systems = systems_of(3);
  SolverSettings weak;
  weak.type = "hypre";
  weak.solver = "jacobi";
  weak.max_iterations = 30;
  int told = 0;
  TuneSearch search(
      systems, solver_candidates(weak, systems), [] { return 0.0; }, 1.0,
      [&](const TuneProgress& p) { told += p.done < p.all ? 1 : 0; });
  const auto ranking = search.run();
  EXPECT_GT(told, 20);
  EXPECT_EQ(search.systems_done(), 3u);
  EXPECT_EQ(ranking.front().state, TuneState::ranked);
  for (const TunedSolver& s : ranking) {
    if (short_name(s.settings) == "hypre jacobi") {
      EXPECT_EQ(s.state, TuneState::failed);
      EXPECT_NE(s.note.find("maximum of iterations"), std::string::npos) << s.note;
    }
    EXPECT_EQ(s.settings.max_iterations, 30);  // bounds of the search do not stay
    if (s.state != TuneState::ranked) continue;
    EXPECT_EQ(s.trials.size(), 3u);
    EXPECT_GE(s.seconds(), ranking.front().seconds());
    for (const solve::SolverTrial& t : s.trials) EXPECT_EQ(t.failure, "");
  }
  const auto curves = search.curves(ranking, 1e-10, 3, 1.0);
  ASSERT_LE(curves.size(), 3u);
  for (const ResidualCurve& c : curves) {
    EXPECT_LE(c.residuals.back(), 1.000001e-10);
    for (std::size_t n = 1; n < c.seconds.size(); ++n) {
      EXPECT_GE(c.seconds[n], c.seconds[n - 1]);
      EXPECT_LT(c.residuals[n], c.residuals[n - 1]);
    }
  }
}

// 1e-9 in every cell, by a share of the norm of the largest right-hand side, in one digit.
TEST(TuneCandidates, SharesMeetAbsoluteGoals) {
  const CapturedSystems systems = systems_of(1);
  SolverSettings deck;
  EXPECT_EQ(relative_tolerance(deck, systems), deck.tolerance);
  deck.norm = Norm::largest;
  deck.tolerance = 0;
  deck.absolute_tolerance = 1e-9;
  const double share = relative_tolerance(deck, systems);
  const double largest = systems.front()->norms(Norm::two).front();
  EXPECT_LE(share * largest, 1e-9 * (1 + 1e-12));
  EXPECT_GT(share * largest, 0.5e-9);
  SolverSettings amg;
  amg.type = "hypreamr";
  amg.tolerance = share;
  EXPECT_EQ(systems.front()->attempt(amg, deck).failure, "");
}

TEST(TuneCandidates, EachOnceAndTheDecksOwnFirst) {
  const CapturedSystems systems = systems_of(1);
  SolverSettings deck;
  deck.type = "hypre";
  deck.relax_type = 2;
  deck.skip = 1;
  const auto list = solver_candidates(deck, systems);
  EXPECT_EQ(short_name(list.front()), "hypre cg+pfmg, relax 2, skip 1");
  for (std::size_t a = 0; a < list.size(); ++a) {
    EXPECT_TRUE(solve::faults_of(list[a]).empty()) << short_name(list[a]);
    for (std::size_t b = 0; b < a; ++b) EXPECT_NE(short_name(list[a]), short_name(list[b]));
  }
}

}  // namespace
}  // namespace sluice::app::tune_search_test
