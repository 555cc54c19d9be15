// Names and ranges of the solvers' parameters.
#include "framework/solve/solver_settings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "framework/base/text.hpp"

namespace sluice::solve {
namespace {

void need_name(std::vector<std::string>& faults, const char* what, const std::string& found,
               const std::vector<std::string>& valid) {
  if (std::find(valid.begin(), valid.end(), found) != valid.end()) return;
  faults.push_back(
      fmt::format("{} '{}' is not known; valid are {}", what, found, join(valid, ", ")));
}

void need_range(std::vector<std::string>& faults, const char* what, int found, int low, int high) {
  if (found >= low && found <= high) return;
  faults.push_back(
      fmt::format("{} is {}; a whole number from {} to {} is needed", what, found, low, high));
}

void need_tolerance(std::vector<std::string>& faults, const char* what, double found) {
  if (std::isfinite(found) && found >= 0) return;
  faults.push_back(fmt::format("{} is {}; a finite number, at least 0, is needed", what, found));
}

}  // namespace

const std::vector<std::string>& solver_types() {
  static const std::vector<std::string> names{"CGSolver", "hypre", "hypreamr"};
  return names;
}

const std::vector<std::string>& hypre_solvers() {
  static const std::vector<std::string> names{"cg",     "pcg",      "gmres", "bicgstab",
                                              "hybrid", "smg",      "pfmg",  "sparsemsg",
                                              "jacobi", "diagonal", "amg"};
  return names;
}

const std::vector<std::string>& hypre_preconditioners() {
  static const std::vector<std::string> names{"none", "diagonal", "jacobi",
                                              "smg",  "pfmg",     "sparsemsg"};
  return names;
}

std::string describe(const SolverSettings& s) {
  const std::string goal = s.absolute_tolerance > 0
                               ? fmt::format(" to {:g} (absolute)", s.absolute_tolerance)
                               : fmt::format(" to {:g}", s.tolerance);
  if (s.type == "CGSolver") return "conjugate gradients with multigrid" + goal;
  if (s.type == "hypreamr" || s.solver == "amg") return "hypre BoomerAMG" + goal;
  const bool alone = s.preconditioner == "none";
  return "hypre " + s.solver + (alone ? "" : " with " + s.preconditioner) + goal;
}

std::vector<std::string> faults_of(const SolverSettings& s) {
  std::vector<std::string> faults;
  constexpr int many = 1000000000;
  need_name(faults, "solver type", s.type, solver_types());
  need_name(faults, "solver", s.solver, hypre_solvers());
  need_name(faults, "preconditioner", s.preconditioner, hypre_preconditioners());
  need_tolerance(faults, "tolerance", s.tolerance);
  need_tolerance(faults, "absolute tolerance", s.absolute_tolerance);
  need_tolerance(faults, "precond_tolerance", s.preconditioner_tolerance);
  need_range(faults, "maxiterations", s.max_iterations, 1, many);
  need_range(faults, "precond_maxiters", s.preconditioner_iterations, 1, many);
  need_range(faults, "npre", s.before, 0, 1000);
  need_range(faults, "npost", s.after, 0, 1000);
  need_range(faults, "skip", s.skip, 0, 1);
  need_range(faults, "jump", s.jump, 0, 30);
  need_range(faults, "relax_type", s.relax_type, 0, 3);
  need_range(faults, "setupFrequency", s.set_up_every, 0, many);
  need_range(faults, "updateCoefFrequency", s.coefficients_every, 1, many);
  need_range(faults, "solveFrequency", s.solve_every, 1, many);
  if (s.norm != Norm::two && s.type != "CGSolver")
    faults.push_back(
        fmt::format("solver type '{}' measures residuals in the norm L2 only", s.type));
  if (s.relax_type > 1 && (s.solver == "sparsemsg" || s.preconditioner == "sparsemsg"))
    faults.push_back(
        fmt::format("sparsemsg does not support relax_type {}; 0 or 1 is needed", s.relax_type));
  return faults;
}

}  // namespace sluice::solve
