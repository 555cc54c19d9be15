// What every solver must say of bad systems, bad settings and solves that do not converge.
#include "framework/solve/linear_solver.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "framework/base/error.hpp"
#include "framework/grid/box_list.hpp"
#include "framework/solve/solve_test_support.hpp"

namespace sluice::solve::linear_solver_test {
namespace {

using testing::HasSubstr;

constexpr IntVec3 cells{12, 10, 8};
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

SolverSettings settings_of(const std::string& name) {
  SolverSettings settings;
  if (name == "CGSolver") return settings;
  settings.type = "hypre";
  settings.solver = name;
  settings.max_iterations = 2000;  // of Jacobi
  settings.tolerance = 1e-8;
  return settings;
}

std::vector<std::string> all_names() {
  std::vector<std::string> names = hypre_solvers();
  names.push_back("CGSolver");
  return names;
}

template <class Error = PhysicsError>
std::string message_of(const std::function<void()>& work) {
  try {
    work();
  } catch (const Error& e) {
    return e.what();
  }
  return "nothing was thrown";
}

class EverySolver : public testing::TestWithParam<std::string> {
 protected:
  std::unique_ptr<Level> level = level_of(cells, {2, 1, 2});
  DiffusionSystem system{0.5, {1, 1, 1}, balls(cells, 1), Sides::neumann};
  std::unique_ptr<LinearSolver> solver = make_linear_solver(settings_of(GetParam()));
};

TEST_P(EverySolver, solves_a_small_system) {
  SolverSettings settings;
  settings.tolerance = 1e-12;
  const auto reference = make_linear_solver(settings);
  reference->set_up(matrix_of(*level, system));
  solver->set_up(matrix_of(*level, system));
  const Solved expected = solve_from_zero(*reference, *level, noisy);
  const Solved found = solve_from_zero(*solver, *level, noisy);
  ASSERT_TRUE(found.report.converged) << found.report.reason;
  EXPECT_GT(found.report.iterations, 0);
  EXPECT_EQ(found.report.residuals.front(), found.report.right_side);
  for (std::size_t b = 0; b < found.x.views().size(); ++b)
    for_each_cell(found.x.views()[b].box, [&](IntVec3 c) {
      ASSERT_NEAR(found.x.views()[b](c), expected.x.views()[b](c), 1e-6);
    });
}

TEST_P(EverySolver, begins_where_it_is_told) {
  solver->set_up(matrix_of(*level, system));
  BoxArrays b(boxes_of(*level, 0)), x(boxes_of(*level, 0));
  fill_views(b.views(), noisy);
  ASSERT_TRUE(solver->solve(b.values(), x.views()).converged);
  const SolveReport again = solver->solve(b.values(), x.views());
  EXPECT_TRUE(again.converged);
  EXPECT_EQ(again.iterations, 0);
}

TEST_P(EverySolver, answers_zero_for_zero) {
  solver->set_up(matrix_of(*level, system));
  BoxArrays b(boxes_of(*level, 0)), x(boxes_of(*level, 0));
  fill_views(x.views(), noisy);
  const SolveReport report = solver->solve(b.values(), x.views());
  EXPECT_TRUE(report.converged) << report.reason;
  for (const RealView& v : x.views()) EXPECT_FALSE(any_other(v, v.box, 0.0));
}

TEST_P(EverySolver, names_the_cell_of_a_coefficient_that_is_no_number) {
  CellMatrix matrix = matrix_of(*level, system);
  matrix.low(1).back()(7, 5, 6) = nan;
  EXPECT_THAT(message_of([&] { solver->set_up(matrix); }),
              HasSubstr("the coupling of cell (7, 5, 6) with the cell below it in y is nan"));
  matrix = matrix_of(*level, system);
  matrix.diagonal().front()(3, 2, 1) = std::numeric_limits<double>::infinity();
  EXPECT_THAT(message_of([&] { solver->set_up(matrix); }),
              HasSubstr("the diagonal of cell (3, 2, 1) is inf; a finite number above 0"));
}

TEST_P(EverySolver, names_the_cell_of_an_empty_row) {
  CellMatrix matrix = matrix_of(*level, system);
  matrix.diagonal().front()(3, 2, 1) = 0;
  EXPECT_THAT(message_of([&] { solver->set_up(matrix); }),
              HasSubstr("the diagonal (an empty row) of cell (3, 2, 1) is 0"));
}

TEST_P(EverySolver, refuses_couplings_with_no_cell) {
  CellMatrix matrix = matrix_of(*level, system);
  matrix.low(0).front()(0, 2, 1) = -1;
  EXPECT_THAT(message_of([&] { solver->set_up(matrix); }),
              HasSubstr("cell (0, 2, 1) is coupled with a cell below it in x that is not one"));
}

TEST_P(EverySolver, names_the_cell_of_a_bad_right_hand_side) {
  solver->set_up(matrix_of(*level, system));
  BoxArrays b(boxes_of(*level, 0)), x(boxes_of(*level, 0));
  b.views().front()(1, 2, 3) = nan;
  EXPECT_THAT(message_of([&] { solver->solve(b.values(), x.views()); }),
              HasSubstr("the right-hand side of cell (1, 2, 3) is nan"));
  b.views().front()(1, 2, 3) = 0;
  x.views().front()(3, 2, 1) = nan;
  EXPECT_THAT(message_of([&] { solver->solve(b.values(), x.views()); }),
              HasSubstr("the start of cell (3, 2, 1) is nan"));
}

TEST_P(EverySolver, tells_that_one_iteration_is_not_enough) {
  SolverSettings settings = settings_of(GetParam());
  settings.max_iterations = 1;
  settings.tolerance = 1e-13;
  const auto hasty = make_linear_solver(settings);
  hasty->set_up(matrix_of(*level, system));
  const Solved solved = solve_from_zero(*hasty, *level, noisy);
  EXPECT_FALSE(solved.report.converged);
  EXPECT_THAT(solved.report.reason, HasSubstr("after 1 iterations"));
  for (const RealView& v : solved.x.views())
    for_each_cell(v.box, [&](IntVec3 c) { ASSERT_TRUE(std::isfinite(v(c))); });
}

TEST_P(EverySolver, ends_with_the_tolerance_zero) {
  SolverSettings settings = settings_of(GetParam());
  settings.tolerance = 0;
  settings.max_iterations = 100;
  const auto strict = make_linear_solver(settings);
  strict->set_up(matrix_of(*level, system));
  const Solved solved = solve_from_zero(*strict, *level, noisy);
  EXPECT_FALSE(solved.report.converged);
  EXPECT_LE(solved.report.iterations, 100);
  EXPECT_THAT(solved.report.reason, HasSubstr(", 0 wanted: "));
  EXPECT_LT(solved.report.residuals.back(), solved.report.right_side);
}

// Faces that nothing flows through have no coupling: a block of cells is left each to itself.
TEST_P(EverySolver, solves_cells_that_no_face_joins) {
  CellMatrix matrix = matrix_of(*level, system);
  const IndexBox block{{3, 2, 2}, {8, 7, 6}};
  const auto apart = [&](IntVec3 c, int d) {
    IntVec3 below = c;
    --below[d];
    return block.contains(c) || block.contains(below);
  };
  for (int d = 0; d < 3; ++d)
    for (const RealView& v : matrix.low(d))
      for_each_cell(v.box, [&](IntVec3 c) {
        if (apart(c, d)) v(c) = 0;
      });
  for (const RealView& v : matrix.diagonal())  // at least as large as the couplings that are left
    for_each_cell(v.box, [&](IntVec3 c) {
      if (block.contains(c)) v(c) = system.diagonal;
    });
  solver->set_up(matrix);
  const Solved solved = solve_from_zero(*solver, *level, noisy);
  EXPECT_TRUE(solved.report.converged) << solved.report.reason;
  for (const RealView& v : solved.x.views())
    for_each_cell(v.box, [&](IntVec3 c) {
      ASSERT_TRUE(!block.contains(c) || std::fabs(v(c) - noisy(c) / system.diagonal) < 1e-5);
    });
}

INSTANTIATE_TEST_SUITE_P(Names, EverySolver, testing::ValuesIn(all_names()),
                         [](const auto& name) { return name.param; });

TEST_P(EverySolver, solves_nothing_after_a_failed_set_up) {
  CellMatrix matrix = matrix_of(*level, system);
  solver->set_up(matrix);
  matrix.diagonal().front()(3, 2, 1) = nan;
  EXPECT_THROW(solver->set_up(matrix), PhysicsError);
  EXPECT_THAT(message_of([&] { solve_from_zero(*solver, *level, noisy); }),
              HasSubstr("no system is set up"));
}

TEST(LinearSolver, tells_that_a_matrix_is_not_positive_definite) {
  const auto level = level_of(cells);
  CellMatrix matrix = matrix_of(*level, {0, {1, 1, 1}});
  fill_views(matrix.diagonal(), [](IntVec3) { return 1.0; });  // rows sum to less than 0
  const auto solver = make_linear_solver({});
  solver->set_up(matrix);
  const Solved solved = solve_from_zero(*solver, *level, noisy);
  EXPECT_FALSE(solved.report.converged);
  EXPECT_THAT(solved.report.reason, HasSubstr("the matrix is not positive definite"));
  for (const RealView& v : solved.x.views())
    for_each_cell(v.box, [&](IntVec3 c) { ASSERT_TRUE(std::isfinite(v(c))); });
}

TEST(SolverSettings, lists_the_valid_names) {
  SolverSettings settings;
  settings.type = "hyper";
  settings.solver = "pfgm";
  settings.preconditioner = "smgg";
  settings.max_iterations = 0;
  settings.tolerance = nan;
  const std::string message = message_of<InputError>([&] { make_linear_solver(settings); });
  EXPECT_THAT(message, HasSubstr("solver type 'hyper' is not known; valid are CGSolver, hypre"));
  EXPECT_THAT(message, HasSubstr("solver 'pfgm' is not known; valid are cg, pcg, gmres"));
  EXPECT_THAT(message, HasSubstr("preconditioner 'smgg' is not known; valid are none, diagonal"));
  EXPECT_THAT(message, HasSubstr("maxiterations is 0; a whole number from 1"));
  EXPECT_THAT(message, HasSubstr("tolerance is nan; a finite number, at least 0"));
}

TEST(LinearSolver, leaves_out_what_is_in_no_box) {
  Level level = *level_of({8, 8, 1}, {2, 2, 1});
  level.boxes.erase(level.boxes.begin() + 2);  // an L of three boxes
  const CellMatrix all = matrix_of(level, {1, {1, 1, 0}});
  const auto solver = make_linear_solver({});
  EXPECT_THAT(message_of([&] { solver->set_up(all); }), HasSubstr("is coupled with a cell below"));
  const BoxFinder cells_of_level(
      {level.boxes[0].cells, level.boxes[1].cells, level.boxes[2].cells});
  CellMatrix matrix(level);
  const auto there = [&](IntVec3 c) { return cells_of_level.covers({c, c + IntVec3{1, 1, 1}}); };
  const auto coupled = [&](IntVec3 c, IntVec3 to) { return there(c + to) ? 1.0 : 0.0; };
  fill_views(matrix.low(0), [&](IntVec3 c) { return -coupled(c, {-1, 0, 0}); });
  fill_views(matrix.low(1), [&](IntVec3 c) { return -coupled(c, {0, -1, 0}); });
  fill_views(matrix.diagonal(), [&](IntVec3 c) {
    return 2 + coupled(c, {-1, 0, 0}) + coupled(c, {1, 0, 0}) + coupled(c, {0, -1, 0}) +
           coupled(c, {0, 1, 0});
  });
  solver->set_up(matrix);
  // Rows sum to 2: a constant solves the system exactly.
  const Solved solved = solve_from_zero(*solver, level, [](IntVec3) { return 6.0; });
  EXPECT_TRUE(solved.report.converged) << solved.report.reason;
  for (const RealView& v : solved.x.views())
    for_each_cell(v.box, [&](IntVec3 c) { EXPECT_NEAR(v(c), 3, 1e-9); });
}

}  // namespace
}  // namespace sluice::solve::linear_solver_test
