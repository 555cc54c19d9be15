// Nanoseconds an unknown that a linear solver takes, set-up included.
//
// usage: sluice_solve_bench [SOLVER [CELLS [BALLS [ASPECT]]]]; default CGSolver, 128, 0, 1.
// CELLS: 128 (cubed) or 128x64x64, in slabs along the last direction on several ranks.
// SOLVER is CGSolver or a name of hypre's, with its preconditioner behind a plus: cg+pfmg. The
// pressure of a gas at a Courant number of sound of 100, to 1e-8, with balls of density 1e4. Prints
// a line that ends with "ns N", the median over repetitions.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "framework/base/communicator.hpp"
#include "framework/base/error.hpp"
#include "framework/solve/solve_test_support.hpp"

namespace {

using namespace sluice;
using namespace sluice::solve;

constexpr double own = 1 / 0.575, face = 0.6 * 100 * 100;
constexpr int repetitions = 3;

SolverSettings settings_of(const std::string& name) {
  SolverSettings settings;
  settings.tolerance = 1e-8;
  settings.max_iterations = 500;
  settings.relax_type = 2;
  if (name == "CGSolver") return settings;
  const std::size_t plus = name.find('+');
  settings.type = "hypre";
  settings.solver = name.substr(0, plus);
  if (plus != std::string::npos) settings.preconditioner = name.substr(plus + 1);
  return settings;
}

IntVec3 cells_of(const char* text) {
  IntVec3 cells;
  if (std::sscanf(text, "%dx%dx%d", &cells.x, &cells.y, &cells.z) == 1) cells.z = cells.y = cells.x;
  return cells;
}

int run(const std::string& name, IntVec3 cells, int count, double aspect) {
  const auto level = level_of(cells, {1, 1, world().size()});
  const CellMatrix matrix =
      matrix_of(*level, {own, {face, face * aspect * aspect, face}, balls(cells, count)});
  const auto solver = make_linear_solver(settings_of(name));
  const BoxArrays right_side(boxes_of(*level, world().rank()));
  const BoxArrays x(boxes_of(*level, world().rank()));
  fill_views(right_side.views(), noisy_without_mean(cells));
  std::vector<double> times;
  SolveReport report;
  for (int r = 0; r < repetitions; ++r) {
    world().barrier();
    solver->set_up(matrix);
    fill_views(x.views(), [](IntVec3) { return 0.0; });
    world().barrier();
    report = solver->solve(right_side.values(), x.views());
    times.push_back((report.set_up_seconds + report.solve_seconds) /
                    static_cast<double>(level->cell_count()) * 1e9);
  }
  std::sort(times.begin(), times.end());
  if (!world().is_root()) return 0;
  std::printf(
      "%s, %d x %d x %d, %d balls, aspect %g: %d iterations, set-up %.3f s, solve %.3f s, %s"
      "ns %.0f\n",
      name.c_str(), cells.x, cells.y, cells.z, count, aspect, report.iterations,
      report.set_up_seconds, report.solve_seconds, report.converged ? "" : "not converged, ",
      times[repetitions / 2]);
  return report.converged ? 0 : 1;
}

}  // namespace

int main(int count, char** values) {
  const auto text = [&](int n, const char* otherwise) { return count > n ? values[n] : otherwise; };
  try {
    const int status = run(text(1, "CGSolver"), cells_of(text(2, "128")), std::atoi(text(3, "0")),
                           std::atof(text(4, "1")));
    world().finalize();
    return status;
  } catch (const Error& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return static_cast<int>(e.status());
  }
}
