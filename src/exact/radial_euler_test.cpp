// The radial Godunov code against exact solutions, its conservation, and its order.
#include "exact/radial_euler.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "exact/noh.hpp"
#include "exact/riemann.hpp"
#include "framework/base/error.hpp"

namespace sluice::exact {
namespace {

RadialProblem sod(int cells, int dimension) {
  RadialProblem problem;
  problem.dimension = dimension;
  problem.cells = cells;
  problem.pieces = {{.5, 1, 0, 1}, {1, .125, 0, .1}};
  return problem;
}

double sod_error(int cells) {
  RadialEuler run(sod(cells, 1));
  run.advance_to(.2);
  const RiemannSolution exact({1, 0, 1}, {.125, 0, .1});
  double sum = 0;
  for (int i = 0; i < cells; ++i) {
    const double x = (i + .5) / cells;
    sum += std::abs(run.at(x).density - exact.sample((x - .5) / .2).density);
  }
  return sum / cells;
}

// Measured 2.44e-3 (N = 200) and 7.32e-4 (N = 800); a second-order Godunov code
// has 2.59e-3, 8.2e-4.
TEST(RadialEuler, PlaneShockTubeConvergesToTheExactSolution) {
  const double coarse = sod_error(200), fine = sod_error(800);
  EXPECT_LT(coarse, 2.7e-3);
  EXPECT_LT(fine, 8.2e-4);
  EXPECT_GT(std::log2(coarse / fine) / 2, .8);
}

TEST(RadialEuler, MassAndEnergyAreKeptWithinWalls) {
  for (int dimension : {1, 2, 3}) {
    RadialEuler run(sod(200, dimension));
    const double mass = run.total_mass(), energy = run.total_energy();
    run.advance_to(.8);  // the shock has met the wall and come back
    EXPECT_NEAR(run.total_mass(), mass, 1e-13 * mass) << dimension;
    EXPECT_NEAR(run.total_energy(), energy, 1e-13 * energy) << dimension;
  }
}

TEST(RadialEuler, UniformGasStaysAtRestInEverySymmetry) {
  for (int dimension : {1, 2, 3}) {
    RadialProblem problem;
    problem.dimension = dimension;
    problem.cells = 64;
    problem.pieces = {{1, 1.3, 0, .7}};
    RadialEuler run(problem);
    run.advance_to(1);
    EXPECT_LT(std::abs(run.at(.01).velocity), 1e-13) << dimension;
    EXPECT_NEAR(run.at(.01).pressure, .7, 1e-13) << dimension;
  }
}

// Converging flow onto an axis: the plateau of Noh's problem, away from the heated axis.
TEST(RadialEuler, CylindricalNohReachesItsPlateau) {
  RadialProblem problem;
  problem.dimension = 2;
  problem.gamma = 5. / 3;
  problem.high = 2;
  problem.outflow = true;
  problem.cells = 1600;
  problem.pieces = {{2, 1, -1, 1e-6}};
  RadialEuler run(problem);
  run.advance_to(.6);
  EXPECT_NEAR(run.at(.1).density, 16, .16);
  EXPECT_NEAR(run.at(.1).pressure, 16. / 3, .06);
  EXPECT_NEAR(run.at(.4).density, 1 + .6 / .4, .01);
  // The shock stands at 0.2 to within two cells.
  EXPECT_GT(run.at(.2 - .003).density, 12);
  EXPECT_LT(run.at(.2 + .003).density, 8);
}

TEST(RadialEuler, RefusesProblemsWithoutSense) {
  RadialProblem problem = sod(100, 3);
  problem.low = .1;
  EXPECT_THROW(RadialEuler{problem}, InputError);
  problem = sod(2, 1);
  EXPECT_THROW(RadialEuler{problem}, InputError);
  problem = sod(100, 1);
  problem.pieces[1].pressure = 0;
  EXPECT_THROW(RadialEuler{problem}, InputError);
}

}  // namespace
}  // namespace sluice::exact
