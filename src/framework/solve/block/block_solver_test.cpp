// Solutions of systems of blocks against dense ones; iterations; bits over threads; what is
// singular.
#include "framework/solve/block/block_solver.hpp"

#include <gtest/gtest.h>

#include <thread>

#include "framework/solve/block/block_test_support.hpp"

namespace sluice::solve::block_solver_test {
namespace {

struct Solved {
  std::vector<double> x;
  BlockReport report;
};

Solved solve(const BlockRows& rows, double tolerance, bool well_conditioned, bool symmetric = true,
             const Workers& workers = {}) {
  BlockSolver solver(workers);
  solver.set_up({&rows, symmetric, well_conditioned});
  Solved s{std::vector<double>(rows.unknowns()), {}};
  s.report = solver.solve(right_side(rows), s.x, tolerance);
  return s;
}

// Two threads that share pieces by their parity, in another order.
Workers two_threads() {
  return {2, [](std::size_t pieces, const Workers::Work& work) {
            const auto half = [&](std::size_t parity) {
              for (std::size_t n = pieces; n-- > 0;)
                if (n % 2 == parity) work(n, static_cast<int>(parity));
            };
            std::thread other(half, 1);
            half(0);
            other.join();
          }};
}

struct Case {
  const char* name;
  Elastic of;
  bool well_conditioned, symmetric;
};

class AgainstDense : public testing::TestWithParam<Case> {};

TEST_P(AgainstDense, SolutionsAgree) {
  const Case& c = GetParam();
  const BlockRows rows = elastic_rows(c.of);
  const Solved s = solve(rows, 1e-12, c.well_conditioned, c.symmetric);
  EXPECT_TRUE(s.report.converged) << s.report.residual / s.report.right_side;
  const std::vector<double> b = right_side(rows), exact = solved(dense(rows), b);
  for (std::size_t i = 0; i < b.size(); ++i) {
    if (b[i] == 0) continue;  // not an unknown
    EXPECT_NEAR(s.x[i], exact[i], 1e-9 * size_of(exact));
  }
}

INSTANTIATE_TEST_SUITE_P(
    BlockSolver, AgainstDense,
    testing::Values(Case{"static_3d", {.cells = {7, 6, 5}}, false, true},
                    Case{"static_2d", {.cells = {20, 15, 0}}, false, true},
                    Case{"static_1d", {.cells = {600, 0, 0}}, false, true},
                    Case{"inertia", {.cells = {7, 6, 5}, .inertia = 5}, true, true},
                    Case{"changes_to_the_cycle", {.cells = {9, 6, 5}}, true, true},
                    Case{"free", {.cells = {7, 6, 5}, .inertia = 0.01, .held = false}, false, true},
                    Case{"not_symmetric", {.cells = {7, 6, 5}, .skew = 0.1}, false, false},
                    Case{"not_symmetric_by_blocks",
                         {.cells = {7, 6, 5}, .inertia = 5, .skew = 0.1},
                         true,
                         false}),
    [](const auto& of) { return std::string(of.param.name); });

// Measured with 6, 12 and 24 cells: 8, 10, 10; the test has the first two.
TEST(BlockSolver, IterationsOfTheCycleHardlyGrowWithTheGrid) {
  const Solved coarse = solve(elastic_rows({.cells = {6, 6, 6}}), 1e-8, false),
               fine = solve(elastic_rows({.cells = {14, 14, 14}}), 1e-8, false);
  EXPECT_TRUE(fine.report.converged);
  EXPECT_LE(fine.report.iterations, 15);
  EXPECT_LE(fine.report.iterations, coarse.report.iterations + 4);
}

// A plate of two cells, and a material that hardly changes its volume (nu .49).
TEST(BlockSolver, ThinAndNearlyIncompressibleBodiesTakeMoreIterations) {
  const Solved plate = solve(elastic_rows({.cells = {24, 24, 2}}), 1e-8, false);
  EXPECT_TRUE(plate.report.converged);
  EXPECT_LE(plate.report.iterations, 40);
  const Solved hard =
      solve(elastic_rows({.cells = {10, 10, 10}, .bulk = 25, .shear = 0.5}), 1e-8, false);
  EXPECT_TRUE(hard.report.converged);
  EXPECT_LE(hard.report.iterations, 60);
}

TEST(BlockSolver, BitsDoNotDependOnThreads) {
  for (const bool blocks : {false, true}) {
    const BlockRows rows = elastic_rows({.cells = {16, 12, 12}, .inertia = 1});
    EXPECT_EQ(solve(rows, 1e-8, blocks).x, solve(rows, 1e-8, blocks, true, two_threads()).x);
  }
}

TEST(BlockSolver, SaysThatAMatrixIsNotPositiveDefinite) {
  for (const bool blocks : {false, true}) {
    const Solved s = solve(elastic_rows({.cells = {8, 8, 8}, .inertia = -0.3}), 1e-8, blocks);
    EXPECT_FALSE(s.report.converged);
    EXPECT_TRUE(s.report.negative_curvature);
  }
}

// A free body under a load that no stress balances.
TEST(BlockSolver, ASingularSystemIsNotSolved) {
  const BlockRows rows = elastic_rows({.cells = {8, 8, 8}, .held = false});
  BlockSolver solver({});
  solver.set_up({&rows, true, false});
  std::vector<double> x(rows.unknowns()), b(rows.unknowns(), 1.0);
  EXPECT_FALSE(solver.solve(b, x, 1e-8).converged);
}

// Rows of very little stiffness are solved as well as others, and rows without stay 0.
TEST(BlockSolver, SmallRowsAreSolvedToo) {
  for (const bool blocks : {false, true}) {
    BlockRows rows = elastic_rows({.cells = {7, 6, 5}, .inertia = 1});
    std::vector<double> scale(rows.count(), 1.0);
    for (std::size_t i = 0; i < scale.size(); i += 5) scale[i] = 1e-5;
    scale[17] = 0;
    for (std::size_t i = 0; i < rows.count(); ++i)
      for (std::size_t e = rows.begin[i]; e < rows.begin[i + 1]; ++e)
        for (std::size_t n = 9 * e; n < 9 * e + 9; ++n)
          rows.value[n] *= scale[i] * scale[static_cast<std::size_t>(rows.column[e])];
    std::vector<double> b = right_side(rows), x(b.size());
    for (std::size_t i = 0; i < b.size(); ++i) b[i] *= scale[i / 3];
    const std::vector<double> exact = solved(dense(rows), b);
    BlockSolver solver({});
    solver.set_up({&rows, true, blocks});
    EXPECT_TRUE(solver.solve(b, x, 1e-10).converged);
    for (std::size_t i = 0; i < x.size(); ++i)
      EXPECT_NEAR(x[i] * scale[i / 3], exact[i] * scale[i / 3], 1e-7);
    for (std::size_t i = 51; i < 54; ++i) EXPECT_EQ(x[i], 0);
  }
}

// The second of two matrices of the same nodes uses the grids of the first.
TEST(BlockSolver, LaterMatricesAreSolvedToo) {
  const BlockRows first = elastic_rows({.cells = {9, 8, 7}}),
                  second = elastic_rows({.cells = {9, 8, 7}, .shear = 2});
  BlockSolver solver({});
  solver.set_up({&first, true, false});
  solver.set_up({&second, true, false});
  std::vector<double> x(second.unknowns()), r(x.size());
  const std::vector<double> b = right_side(second);
  EXPECT_TRUE(solver.solve(b, x, 1e-10).converged);
  multiply(second, {}, x, r);
  EXPECT_LT(distance(r, b), 1e-9 * size_of(b));
}

}  // namespace
}  // namespace sluice::solve::block_solver_test
