// Sod's shock tube as a radial problem, and how far a radial code is from it.
#pragma once
#include <cmath>

#include "exact/radial/radial_problem.hpp"
#include "exact/riemann/riemann.hpp"

namespace sluice::exact {

inline RadialProblem sod(int cells, int dimension) {
  RadialProblem problem;
  problem.dimension = dimension;
  problem.cells = cells;
  problem.pieces = {{.5, 1, 0, 1}, {1, .125, 0, .1}};
  return problem;
}

// Mean error of the density at t = 0.2 over so many points.
template <class Code>
double sod_error(int cells, int points) {
  Code run(sod(cells, 1));
  run.advance_to(.2);
  const RiemannSolution exact({1, 0, 1}, {.125, 0, .1});
  double sum = 0;
  for (int i = 0; i < points; ++i) {
    const double x = (i + .5) / points;
    sum += std::abs(run.at(x).density - exact.sample((x - .5) / .2).density);
  }
  return sum / points;
}

}  // namespace sluice::exact
