#include "mpm/implicit/node_solver.hpp"

#include <cmath>

namespace sluice::mpm {
namespace {

// Unknowns up to which a direct solution is faster, by the number of directions with cells.
constexpr int most_direct[4] = {1000000, 1000000, 10000, 1000};
constexpr int most_direct_at_last = 20000;  // where conjugate gradients fail
// Asymmetry of tangents up to which their symmetric part serves Newton's method.
constexpr double nearly_symmetric = 1e-2;
// Part of storage in the diagonal from which block Jacobi takes a few iterations: their number
// grows with the root of its inverse.
constexpr double well_conditioned = 0.02;
constexpr double least_help = 0.5;  // of the right-hand side

}  // namespace

NodeSolver::NodeSolver(System system, const solve::Workers& workers, SparseSolver& direct)
    : system_(std::move(system)), direct_(&direct), blocks_(workers) {
  number_.assign(system_.free.size(), -1);
  for (std::size_t i = 0; i < number_.size(); ++i)
    if (system_.free[i] != 0) number_[i] = unknowns_++;
  system_.direct = system_.direct || unknowns_ <= most_direct[system_.dimensions];
}

bool NodeSolver::takes_symmetric(double asymmetry) const {
  // A direct solution takes the matrix as it is: of few particles it may have modes without
  // stiffness, and round-off that breaks the symmetry of a deck would move them.
  return !system_.direct && asymmetry <= nearly_symmetric;
}

double NodeSolver::norm(const std::vector<double>& r) const {
  return system_.direct ? std::sqrt(solve::dot({}, r, r)) : blocks_.norm(r);
}

void NodeSolver::set_up(double asymmetry, double share_of_storage) {
  if (system_.direct) return;
  blocks_.set_up({system_.rows, takes_symmetric(asymmetry), share_of_storage > well_conditioned,
                  system_.inexact});
}

NodeSolver::Solution NodeSolver::solve(const std::vector<double>& b, std::vector<double>& x,
                                       double tolerance) {
  x.assign(b.size(), 0.0);
  if (system_.direct) return solve_directly(b, x);
  const solve::BlockReport report = blocks_.solve(b, x, tolerance);
  Solution solution;
  solution.iterations = report.iterations;
  solution.residual = report.right_side > 0 ? report.residual / report.right_side : 0;
  solution.solved = report.converged;
  solution.negative_curvature = report.negative_curvature;
  solution.helps = solution.residual < least_help;
  if (solution.solved || solution.negative_curvature || unknowns_ > most_direct_at_last)
    return solution;
  const int iterations = solution.iterations;
  solution = solve_directly(b, x);
  solution.iterations = iterations;
  return solution;
}

NodeSolver::Solution NodeSolver::solve_directly(const std::vector<double>& b,
                                                std::vector<double>& x) {
  const SparseRows rows = sparse_rows(*system_.rows, number_);
  std::vector<double> right(static_cast<std::size_t>(unknowns_)), solution;
  for (std::size_t i = 0; i < b.size(); ++i)
    if (number_[i] >= 0) right[static_cast<std::size_t>(number_[i])] = b[i];
  Solution how;
  how.solved = how.helps = direct_->solve(rows, right, solution);
  how.negative_curvature = direct_->indefinite();
  if (!how.solved) return how;
  for (std::size_t i = 0; i < b.size(); ++i)
    x[i] = number_[i] >= 0 ? solution[static_cast<std::size_t>(number_[i])] : 0;
  return how;
}

}  // namespace sluice::mpm
