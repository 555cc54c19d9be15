// The solver of systems with matrices of blocks: conjugate gradients with block Jacobi where few
// iterations are expected, else with the multigrid cycle; BiCGSTAB where the matrix is not
// symmetric.
//
// The bits of a solution depend on the matrix and the right-hand side alone.
#pragma once
#include <optional>

#include "framework/solve/block/block_cycle.hpp"
#include "framework/solve/block/block_iteration.hpp"

namespace sluice::solve {

class BlockSolver {
 public:
  explicit BlockSolver(Workers workers);

  struct Matrix {
    const BlockRows* rows;  // must stay while it is solved
    bool symmetric = true;
    bool well_conditioned = false;  // block Jacobi takes a few iterations
    bool inexact = false;           // errors of 6e-8 of the matrix do no harm
  };
  // Of a series of matrices with the same nodes the later ones use the grids of the first.
  void set_up(const Matrix& matrix);

  // x: where to begin, then the solution; 0 for unknowns without stiffness. The norm() of the
  // residual is at most `tolerance` times that of b, computed from the solution once more. A
  // solution that the report does not call converged is the best that was found.
  BlockReport solve(std::span<const double> b, std::span<double> x, double tolerance);

  // sqrt(r . D^-1 r), D the diagonal blocks of the matrix.
  double norm(std::span<const double> r) const;

  // Whether the solver has changed to the cycle, or began with it.
  bool uses_cycle() const { return cycle_ready_; }

 private:
  bool prepare_cycle(Chebyshev::Estimate estimate);
  bool replace_preconditioner();
  bool rounds() const;
  void multiply(std::span<const double> x, std::span<double> y) const;
  BlockReport iterate(std::span<const double> b, std::span<double> x, double tolerance);
  BlockReport attempt(std::span<const double> b, std::span<double> x, double goal,
                      int max_iterations);

  Workers workers_;
  Matrix matrix_{};
  BlockDiagonal diagonal_;
  RoundedRows rounded_;  // of a well-conditioned matrix, if it may be inexact
  BlockCycle cycle_{workers_};
  BlockRows half_;  // the symmetric part of a matrix that is not symmetric, for the cycle
  bool cycle_ready_ = false, cycle_refused_ = false, cycle_careful_ = false;
};

}  // namespace sluice::solve
