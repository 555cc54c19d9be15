#include "framework/solve/block/block_solver.hpp"

#include <algorithm>
#include <cmath>

namespace sluice::solve {
namespace {

// As many iterations of block Jacobi as the set-up of the cycle costs, about.
constexpr int most_by_blocks = 40;
constexpr int most_by_cycle = 200;
constexpr int most_without_cycle = 2000;
constexpr int most_restarts = 3;  // from a residual that recursion has lost
constexpr double lost = 2;        // residual of the solution over the goal: recursion has lost it

}  // namespace

BlockSolver::BlockSolver(Workers workers) : workers_(std::move(workers)) {}

void BlockSolver::set_up(const Matrix& matrix) {
  matrix_ = matrix;
  cycle_ready_ = cycle_refused_ = cycle_careful_ = false;
  diagonal_.invert(*matrix.rows);
  if (!matrix.well_conditioned) prepare_cycle(Chebyshev::Estimate::quick);
  if (rounds()) rounded_.round(*matrix.rows, workers_);
}

// Of other matrices rounding may change the sign of the smallest eigenvalue.
bool BlockSolver::rounds() const {
  return matrix_.inexact && matrix_.well_conditioned && !cycle_ready_ && !cycle_refused_;
}

void BlockSolver::multiply(std::span<const double> x, std::span<double> y) const {
  if (rounds())
    rounded_.multiply(workers_, x, y);
  else
    solve::multiply(*matrix_.rows, workers_, x, y);
}

bool BlockSolver::prepare_cycle(Chebyshev::Estimate estimate) {
  const BlockRows* rows = matrix_.rows;
  if (!matrix_.symmetric) {
    half_ = symmetric_part(*rows);
    rows = &half_;
  }
  cycle_ready_ = cycle_.set_up(*rows, estimate);
  cycle_refused_ = !cycle_ready_;
  return cycle_ready_;
}

// The next that may do better: from block Jacobi to the cycle, to the cycle with more work on its
// smoothers, to block Jacobi again with as many iterations as it needs. False: there is none.
bool BlockSolver::replace_preconditioner() {
  if (cycle_refused_) return false;
  if (!cycle_ready_) {
    prepare_cycle(Chebyshev::Estimate::quick);
    return true;
  }
  if (!cycle_careful_) {
    cycle_careful_ = true;
    prepare_cycle(Chebyshev::Estimate::careful);
  } else {
    cycle_refused_ = true;
    cycle_ready_ = false;
  }
  return true;
}

double BlockSolver::norm(std::span<const double> r) const {
  return weighted_norm([this](std::span<const double> from,
                              std::span<double> to) { diagonal_.apply(workers_, from, to); },
                       workers_, r);
}

BlockReport BlockSolver::attempt(std::span<const double> b, std::span<double> x, double goal,
                                 int max_iterations) {
  const LinearMap A = [this](std::span<const double> from, std::span<double> to) {
    multiply(from, to);
  };
  const LinearMap by_blocks = [this](std::span<const double> from, std::span<double> to) {
    diagonal_.apply(workers_, from, to);
  };
  const LinearMap by_cycle = [this](std::span<const double> from, std::span<double> to) {
    cycle_.apply(from, to);
  };
  const LinearMap& preconditioner = cycle_ready_ ? by_cycle : by_blocks;
  const BlockGoal all{goal, max_iterations, by_blocks};
  return matrix_.symmetric ? conjugate_gradients(A, preconditioner, workers_, b, x, all)
                           : bicgstab(A, preconditioner, workers_, b, x, all);
}

BlockReport BlockSolver::solve(std::span<const double> b, std::span<double> x, double tolerance) {
  const BlockReport report = iterate(b, x, tolerance);
  diagonal_.clear_unmoved(x);  // where interpolation has written
  return report;
}

BlockReport BlockSolver::iterate(std::span<const double> b, std::span<double> x, double tolerance) {
  BlockReport all;
  all.right_side = norm(b);
  const double goal = tolerance * all.right_side;
  std::vector<double> r(b.size());
  for (int restarts = 0; restarts <= most_restarts;) {
    const int most = cycle_ready_     ? most_by_cycle
                     : cycle_refused_ ? most_without_cycle
                                      : most_by_blocks;
    const BlockReport now = attempt(b, x, goal, most);
    all.iterations += now.iterations;
    all.negative_curvature = now.negative_curvature;
    multiply(x, r);
    for (std::size_t i = 0; i < b.size(); ++i) r[i] = b[i] - r[i];
    all.residual = norm(r);
    all.converged = all.residual <= lost * goal;
    if (all.converged || all.negative_curvature || !std::isfinite(all.residual)) return all;
    if (now.converged)
      ++restarts;
    else if (!replace_preconditioner())
      return all;
  }
  return all;
}

}  // namespace sluice::solve
