// Conjugate gradients and BiCGSTAB for matrices of blocks, with any preconditioner.
//
// Y. Saad, Iterative Methods for Sparse Linear Systems (2003), algorithm 9.1; H. A. van der
// Vorst, SIAM J. Sci. Stat. Comput. 13 (1992) 631, with right preconditioning.
#pragma once
#include <functional>
#include <string>

#include "framework/solve/block/block_rows.hpp"

namespace sluice::solve {

// y = f(x), of as many numbers.
using LinearMap = std::function<void(std::span<const double> x, std::span<double> y)>;

struct BlockGoal {
  double residual = 0;       // norm, at most
  int max_iterations = 100;  // products with the preconditioner may be twice as many
  // W of the norm sqrt(r . W r): with the inverse of the diagonal blocks, rows of little stiffness
  // count as much as others.
  LinearMap weight = {};
};

struct BlockReport {
  bool converged = false;
  int iterations = 0;
  double residual = 0;    // norm
  double right_side = 0;  // norm
  // p . A p <= 0 for a direction p: the matrix is not positive definite.
  bool negative_curvature = false;
  // r . z <= 0 for a residual r and what the preconditioner C makes of it: C is not.
  bool negative_preconditioner = false;
};

// sqrt(r . W r).
double weighted_norm(const LinearMap& weight, const Workers& workers, std::span<const double> r);

// A and the preconditioner are symmetric. From the x given, to a residual as the recursion has it.
BlockReport conjugate_gradients(const LinearMap& A, const LinearMap& preconditioner,
                                const Workers& workers, std::span<const double> b,
                                std::span<double> x, const BlockGoal& goal);
// A is any matrix. x is the best that was found, also where the goal is not met.
BlockReport bicgstab(const LinearMap& A, const LinearMap& preconditioner, const Workers& workers,
                     std::span<const double> b, std::span<double> x, const BlockGoal& goal);

}  // namespace sluice::solve
