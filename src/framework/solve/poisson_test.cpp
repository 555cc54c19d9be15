// Manufactured Poisson problems with every mix of sides: second order in the largest error.
#include <gtest/gtest.h>

#include "framework/solve/solve_test_support.hpp"

namespace sluice::solve::poisson_test {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double min_order = 1.9;  // measured 1.94 and more

struct Problem {
  std::string solver;
  Sides sides;
  int dimensions;
};

std::ostream& operator<<(std::ostream& out, const Problem& p) {
  return out << p.solver << ", sides " << static_cast<int>(p.sides) << ", " << p.dimensions << "-D";
}

// One factor of the solution: its second derivative is -(wave)^2 times itself. Mixed sides: value 0
// below and slope 0 above in directions 0 and 2, the other way round in direction 1.
struct Factor {
  double wave;
  bool sine;
  double operator()(double x) const { return sine ? std::sin(wave * x) : std::cos(wave * x); }
};

Factor factor_of(Sides sides, int direction) {
  switch (sides) {
    case Sides::dirichlet:
      return {pi, true};
    case Sides::neumann:
      return {pi, false};
    case Sides::periodic:
      return {2 * pi, true};
    case Sides::mixed:
      break;
  }
  return {pi / 2, direction != 1};
}

double largest_error(const Problem& p, int n) {
  const IntVec3 cells{n, n, p.dimensions == 3 ? n : 1};
  const auto level = level_of(cells, {2, 1, 1}, p.sides);
  const double h = 1.0 / n;
  SolverSettings settings;
  if (p.solver != "CGSolver") {
    settings.type = "hypre";
    settings.solver = p.solver;
  }
  settings.max_iterations = 200;
  const auto solver = make_linear_solver(settings);
  DiffusionSystem system;
  system.sides = p.sides;
  system.coupling = Vec3::all(1 / (h * h));
  solver->set_up(matrix_of(*level, system));
  double waves = 0;
  for (int d = 0; d < p.dimensions; ++d) waves += std::pow(factor_of(p.sides, d).wave, 2);
  const auto exact = [&](IntVec3 c) {
    double u = 1;
    for (int d = 0; d < p.dimensions; ++d) u *= factor_of(p.sides, d)((c[d] + 0.5) * h);
    return u;
  };
  const Solved solved =
      solve_from_zero(*solver, *level, [&](IntVec3 c) { return waves * exact(c); });
  EXPECT_TRUE(solved.report.converged) << solved.report.reason;
  double largest = 0;
  for (const RealView& v : solved.x.views()) {
    for_each_cell(v.box,
                  [&](IntVec3 c) { largest = std::max(largest, std::fabs(v(c) - exact(c))); });
  }
  return largest;
}

class Poisson : public testing::TestWithParam<Problem> {};

TEST_P(Poisson, is_of_second_order) {
  const int n = GetParam().dimensions == 3 ? 12 : 24;
  const double coarse = largest_error(GetParam(), n);
  const double fine = largest_error(GetParam(), 2 * n);
  EXPECT_GT(std::log2(coarse / fine), min_order);
}

std::vector<Problem> problems() {
  std::vector<Problem> all;
  for (const char* solver : {"CGSolver", "cg", "amg"})
    for (const Sides sides : {Sides::dirichlet, Sides::neumann, Sides::mixed, Sides::periodic})
      for (const int dimensions : {2, 3}) all.push_back({solver, sides, dimensions});
  return all;
}

INSTANTIATE_TEST_SUITE_P(AllSides, Poisson, testing::ValuesIn(problems()));

}  // namespace
}  // namespace sluice::solve::poisson_test
