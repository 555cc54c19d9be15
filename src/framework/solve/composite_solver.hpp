// Conjugate gradients on all levels at once, with a cycle of the levels.
//
// The cycle corrects the levels one after the other, finest to coarsest and back, each by a
// multigrid cycle on the whole of it for what the corrections before have left (a symmetric
// multiplicative Schwarz method); or it is a cycle of hypre's BoomerAMG on all of them at once. The
// bits of a result do not depend on boxes, ranks or threads.
// S. F. McCormick, Multilevel Adaptive Methods for Partial Differential Equations (1989), ch. 4.
#pragma once
#include <memory>
#include <vector>

#include "framework/solve/composite_system.hpp"
#include "framework/solve/linear_solver.hpp"
#include "framework/solve/multigrid_cycle.hpp"

namespace sluice::solve {

class CompositeAmg;

// `hypreamr`, and `amg` of hypre: by BoomerAMG; all other types: by the cycle of the levels.
bool takes_amg_on_levels(const SolverSettings& settings);

class CompositeSolver {
 public:
  explicit CompositeSolver(const SolverSettings& settings);
  ~CompositeSolver();

  // Both collective. Throws PhysicsError as CompositeSystem; the levels must stay.
  void set_up(std::span<const LevelCoefficients> levels);
  // From 0; b summed over the volume of each cell, 0 in covered ones. Units as in cell_matrix.hpp.
  SolveReport solve(const CompositeVector& b, CompositeVector& x);
  const CompositeSystem& system() const { return *system_; }

 private:
  void precondition(const CompositeVector& r, CompositeVector& z);
  void correct_level(std::size_t level, CompositeVector& rest, CompositeVector& z);

  SolverSettings settings_;
  std::unique_ptr<CompositeSystem> system_;
  std::vector<MultigridCycle> cycles_;  // of each level; none where amg_ serves
  std::unique_ptr<CompositeAmg> amg_;
  CompositeVector r_, z_, p_, q_, rest_, gathered_, correction_;
  double set_up_seconds_ = 0;
};

}  // namespace sluice::solve
