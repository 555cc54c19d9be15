// hypre's conjugate gradients with BoomerAMG, which knows a matrix by its rows alone: for what
// neither grids nor lines follow.
#pragma once
#include <HYPRE_IJ_mv.h>
#include <HYPRE_krylov.h>
#include <HYPRE_parcsr_ls.h>

#include "framework/solve/hypre_tools.hpp"
#include "framework/solve/linear_solver.hpp"

namespace sluice::solve {

// BoomerAMG as measured best on pressures with jumps of density, with one level of aggressive
// coarsening; all else is hypre's default.
void choose_amg_methods(HYPRE_Solver amg);
// Assembled objects as the solvers take them.
HYPRE_ParCSRMatrix parcsr_matrix(HYPRE_IJMatrix from);
HYPRE_ParVector par_vector(HYPRE_IJVector from);

class HypreAmgSolver : public LinearSolver {
 public:
  explicit HypreAmgSolver(const SolverSettings& settings) : LinearSolver(settings) {}

 private:
  static HYPRE_Int precondition(HYPRE_Solver self, HYPRE_ParCSRMatrix, HYPRE_ParVector,
                                HYPRE_ParVector);
  void prepare(const DenseSystem& system) override;
  bool can_renew() const override { return true; }
  void renew(const DenseSystem& system) override;
  Attempt attempt(const DenseSystem& system, const DenseVector& b, DenseVector& x,
                  const Goal& goal) override;
  void make_matrix();
  void fill_matrix(const DenseSystem& system);
  void make_solvers();
  void make_vector(HypreObject<HYPRE_IJVector, HYPRE_IJVectorDestroy>& vector,
                   const DenseVector& v);
  void put(HYPRE_IJVector to, const DenseVector& v);

  Slab slab_;
  HypreObject<HYPRE_IJMatrix, HYPRE_IJMatrixDestroy> matrix_;
  HypreObject<HYPRE_IJVector, HYPRE_IJVectorDestroy> b_, x_, ones_;  // ones: of the unknowns
  HypreObject<HYPRE_Solver, HYPRE_BoomerAMGDestroy> cycle_;
  HypreObject<HYPRE_Solver, HYPRE_ParCSRPCGDestroy> gradients_;
  bool singular_ = false;
  double unknowns_ = 0;
  std::vector<double> numbers_;  // of the slab
  std::vector<HYPRE_BigInt> rows_;
};

}  // namespace sluice::solve
