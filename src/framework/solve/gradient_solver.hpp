// Our own solver: conjugate gradients with the multigrid cycle, and exact dot products.
//
// The bits of a result depend on the system alone, not on boxes, ranks or threads.
// Y. Saad, Iterative Methods for Sparse Linear Systems (2003), algorithm 9.1.
#pragma once
#include "framework/solve/linear_solver.hpp"
#include "framework/solve/multigrid_cycle.hpp"

namespace sluice::solve {

class GradientSolver : public LinearSolver {
 public:
  explicit GradientSolver(const SolverSettings& settings) : LinearSolver(settings) {}

 private:
  void prepare(const DenseSystem& system) override;
  Attempt attempt(const DenseSystem& system, const DenseVector& b, DenseVector& x,
                  const Goal& goal) override;
  MultigridCycle cycle_;
  DenseVector r_, z_, p_, q_;
};

}  // namespace sluice::solve
