// Systems that a run solved, kept: what was asked for, with all right-hand sides; trials of solvers
// on them meet the goal that they are given, and tell why where they do not.
#include "framework/solve/captured_system.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "framework/solve/composite_solver.hpp"
#include "framework/solve/solve_test_support.hpp"

namespace sluice::solve::captured_system_test {
namespace {

constexpr IntVec3 cells{16, 12, 1};

// Solves that many systems in turn, each for two right-hand sides; the diagonal tells which.
void solve_some(int count, const SolverSettings& settings = {}) {
  const auto level = level_of(cells, {2, 1, 1});
  for (int n = 1; n <= count; ++n) {
    const auto solver = make_linear_solver(settings);
    solver->set_up(matrix_of(*level, {.diagonal = 0.1 * n}));
    solve_from_zero(*solver, *level, noisy);
    solve_from_zero(*solver, *level, [](IntVec3 c) { return c.x == 3 ? 1.0 : 0.0; });
  }
}

std::vector<int> numbers_kept(std::size_t wanted, int solved) {
  SystemCapture capture(wanted, 1);
  solve_some(solved);
  EXPECT_EQ(capture.count(), solved);
  std::vector<int> numbers;
  for (const auto& system : capture.take()) numbers.push_back(system->number());
  return numbers;
}

TEST(CapturedSystem, KeepsSystemsOverTheWholeRun) {
  using testing::ElementsAre;
  EXPECT_THAT(numbers_kept(3, 1), ElementsAre(1));
  EXPECT_THAT(numbers_kept(3, 2), ElementsAre(1, 2));
  EXPECT_THAT(numbers_kept(3, 3), ElementsAre(1, 2, 3));
  EXPECT_THAT(numbers_kept(3, 6), ElementsAre(2, 4, 6));
  EXPECT_THAT(numbers_kept(1, 7), ElementsAre(7));
  // Whatever the length, within an eighth of the run of where they should be.
  for (const int solved : {10, 29, 64, 101}) {
    const std::vector<int> kept = numbers_kept(3, solved);
    ASSERT_EQ(kept.size(), 3u) << solved;
    EXPECT_NEAR(kept[0], solved / 3.0, solved / 8.0) << solved;
    EXPECT_NEAR(kept[1], 2 * solved / 3.0, solved / 8.0) << solved;
    EXPECT_EQ(kept[2], solved);
  }
}

TEST(CapturedSystem, KeepsMatricesWithTheirRightHandSides) {
  SystemCapture capture(3, 8);
  solve_some(3);
  const auto systems = capture.take();
  ASSERT_EQ(systems.size(), 3u);
  for (const auto& system : systems) {
    EXPECT_EQ(system->unknowns(), cells.x * cells.y);
    EXPECT_EQ(system->levels(), 1);
    EXPECT_EQ(system->right_sides(), 2u);
  }
  // Twelve cells hold 1.
  EXPECT_NEAR(systems[0]->norms(Norm::two).at(1), std::sqrt(12.0), 1e-14);
  EXPECT_NEAR(systems[0]->norms(Norm::one).at(1), 12.0, 1e-14);
}

TEST(CapturedSystem, DropsSystemsWithoutARightHandSide) {
  SystemCapture capture(1, 8);
  const auto level = level_of(cells);
  const auto solver = make_linear_solver({});
  solver->set_up(matrix_of(*level, {.diagonal = 1}));
  solve_from_zero(*solver, *level, [](IntVec3) { return 0.0; });
  EXPECT_TRUE(capture.take().empty());
}

TEST(CapturedSystem, NobodyIsToldWhenTheWatchHasGone) {
  { const SystemCapture capture(1, 8); }
  EXPECT_EQ(LinearSystemObserver::current(), nullptr);
  solve_some(1);
  const SystemCapture again(1, 8);
  EXPECT_EQ(LinearSystemObserver::current(), &again);
  EXPECT_THROW(SystemCapture(1, 8), std::logic_error);
}

std::vector<std::unique_ptr<CapturedSystem>> captured(int count) {
  SystemCapture capture(1, 8);
  solve_some(count);
  return capture.take();
}

// The same goal for all: no more than 1e-9 in any cell, whatever a solver measures itself.
TEST(CapturedSystem, TrialsOfAllSolversMeetTheGoal) {
  const auto systems = captured(1);
  SolverSettings goal;
  goal.tolerance = 0;
  goal.absolute_tolerance = 1e-9;
  goal.norm = Norm::largest;
  for (const char* type : {"CGSolver", "hypreamr", "hypre"}) {
    SolverSettings solver;
    solver.type = type;
    solver.tolerance = 1e-11;
    const SolverTrial trial = systems.front()->attempt(solver, goal);
    EXPECT_EQ(trial.failure, "") << type;
    EXPECT_LE(trial.residual, 1.0) << type;
    EXPECT_GT(trial.iterations, 1) << type;
    EXPECT_GT(trial.seconds(), 0.0) << type;
    // One right-hand side takes a part of what both do.
    EXPECT_LT(systems.front()->attempt(solver, goal, 1).iterations, trial.iterations) << type;
  }
}

TEST(CapturedSystem, TellsWhyATrialFails) {
  const auto systems = captured(1);
  SolverSettings goal;
  goal.tolerance = 1e-12;
  SolverSettings loose;
  loose.tolerance = 1e-2;
  const SolverTrial missed = systems.front()->attempt(loose, goal);
  EXPECT_THAT(missed.failure, testing::HasSubstr("wanted"));
  EXPECT_GT(missed.residual, 1e3);
  SolverSettings few;
  few.max_iterations = 2;
  EXPECT_THAT(systems.front()->attempt(few, goal).failure,
              testing::HasSubstr("maximum of iterations"));
  SolverSettings unknown;
  unknown.type = "hypre";
  unknown.solver = "abacus";
  const SolverTrial refused = systems.front()->attempt(unknown, goal);
  EXPECT_THAT(refused.failure, testing::HasSubstr("'abacus' is not known"));
  EXPECT_FALSE(std::isfinite(refused.residual));
}

TEST(CapturedSystem, OfASingularSystemTheMeanIsNoPartOfTheGoal) {
  SystemCapture capture(1, 8);
  const auto level = level_of(cells);
  const auto solver = make_linear_solver({});
  solver->set_up(matrix_of(*level, {}));
  solve_from_zero(*solver, *level, noisy);
  const auto systems = capture.take();
  EXPECT_EQ(systems.front()->attempt({}, {}).failure, "");
}

// A square in a square: 8 x 8 cells, of which 4 x 4 are covered by 8 x 8 finer ones.
TEST(CapturedSystem, KeepsSystemsOfSeveralLevels) {
  Level coarse, fine;
  for (Level* l : {&coarse, &fine}) {
    const int n = l == &coarse ? 8 : 16, from = l == &coarse ? 0 : 4, to = l == &coarse ? 8 : 12;
    l->index = l == &coarse ? 0 : 1;
    l->active = {true, true, false};
    l->domain = {{0, 0, 0}, {n, n, 1}};
    l->spacing = {1.0 / n, 1.0 / n, 1.0};
    l->ratio = {2, 2, 1};
    l->boxes = {{{{from, from, 0}, {to, to, 1}}, 0, 0}};
  }
  std::vector<LevelCoefficients> parts;
  for (const Level* l : {&coarse, &fine}) {
    LevelCoefficients& c = parts.emplace_back(*l, 0);
    fill_views(c.own.views(), [&](IntVec3) { return 0.1 * l->cell_volume(); });
    for (std::size_t d = 0; d < 2; ++d)
      for (const BoxArrays* face : {&c.low[d], &c.high[d]})
        fill_views(face->views(), [](IntVec3) { return 1.0; });
  }
  SystemCapture capture(1, 8);
  CompositeSolver solver({});
  solver.set_up(parts);
  CompositeVector b = solver.system().vector(), x = b;
  const BoxArrays numbers(boxes_of(fine, 0));
  fill_views(numbers.views(), noisy);
  solver.system().load(1, numbers.values(), b);
  const SolveReport report = solver.solve(b, x);
  const auto systems = capture.take();
  ASSERT_EQ(systems.size(), 1u);
  EXPECT_EQ(systems.front()->levels(), 2);
  EXPECT_EQ(systems.front()->unknowns(), 64 - 16 + 64);
  const SolverTrial trial = systems.front()->attempt({}, {});
  EXPECT_EQ(trial.failure, "");
  EXPECT_EQ(trial.iterations, report.iterations);
}

}  // namespace
}  // namespace sluice::solve::captured_system_test
