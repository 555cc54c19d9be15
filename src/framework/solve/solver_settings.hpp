// Which linear solver, and its parameters under the names that decks give them.
#pragma once
#include <string>
#include <vector>

namespace sluice::solve {

enum class Norm { two, one, largest };

struct SolverSettings {
  std::string type = "CGSolver";        // our own solver; or hypre, hypreamr
  std::string solver = "cg";            // <solver>, of hypre
  std::string preconditioner = "pfmg";  // <preconditioner>, of hypre
  double tolerance = 1e-10;             // of the residual's norm over the right-hand side's
  double absolute_tolerance = 0;        // of the residual's norm; the larger one decides
  int max_iterations = 75;              // <maxiterations>
  Norm norm = Norm::two;                // <norm>; hypre has the 2-norm only
  int preconditioner_iterations = 1;    // <precond_maxiters>
  double preconditioner_tolerance = 0;  // <precond_tolerance>
  int before = 1, after = 1;            // <npre>, <npost>: sweeps around a coarse correction
  int skip = 0;                         // <skip>: PFMG smooths no level that it need not
  int jump = 0;                         // <jump>, of SparseMSG
  int relax_type = 1;                   // 0 Jacobi, 1 weighted, 2 red-black, 3 not symmetric

  // Steps that each serves. 0: while the coefficients drift little; 1: anew in every step. Who
  // solves counts those of the other two.
  int set_up_every = 0;        // <setupFrequency>
  int coefficients_every = 1;  // <updateCoefFrequency>
  int solve_every = 1;         // <solveFrequency>
};

const std::vector<std::string>& solver_types();
const std::vector<std::string>& hypre_solvers();
const std::vector<std::string>& hypre_preconditioners();

// In a few words: "hypre cg with pfmg to 1e-10".
std::string describe(const SolverSettings& settings);
// All that is wrong, a line each, with the valid names; empty when nothing is.
std::vector<std::string> faults_of(const SolverSettings& settings);

}  // namespace sluice::solve
