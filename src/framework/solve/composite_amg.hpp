// One cycle of hypre's BoomerAMG on the whole system of several levels, as a preconditioner:
// symmetric and positive.
//
// Every rank holds and solves all of it, so that no bit depends on ranks; unknowns are numbered by
// level and place, so that none depends on boxes.
#pragma once
#include <HYPRE_IJ_mv.h>
#include <HYPRE_parcsr_ls.h>

#include "framework/solve/composite_system.hpp"
#include "framework/solve/hypre_tools.hpp"

namespace sluice::solve {

class CompositeAmg {
 public:
  // Throws PhysicsError where hypre's set-up fails, InputError where it cannot number the unknowns.
  explicit CompositeAmg(const CompositeSystem& system);
  // z = B r; covered cells of z get 0.
  void apply(const CompositeVector& r, CompositeVector& z);

 private:
  using Vector = HypreObject<HYPRE_IJVector, HYPRE_IJVectorDestroy>;
  void number_unknowns(const CompositeSystem& system);
  void fill(const CompositeSystem& system);
  void add_row(const DenseSystem& rows, const std::vector<HYPRE_BigInt>& number, std::ptrdiff_t c,
               const std::array<int, 3>& cell);
  void add(HYPRE_BigInt row, HYPRE_Int n, const HYPRE_BigInt* columns, const double* values);
  void make(Vector& vector);
  void put(const Vector& to);

  std::vector<std::vector<std::ptrdiff_t>> places_;  // of the unknowns, by level
  std::vector<std::vector<HYPRE_BigInt>> number_;    // of each place, by level; -1: no unknown
  std::vector<HYPRE_BigInt> numbers_;                // 0, 1, 2, ...
  std::vector<double> values_;
  HypreObject<HYPRE_IJMatrix, HYPRE_IJMatrixDestroy> matrix_;
  Vector b_, x_;
  HypreObject<HYPRE_Solver, HYPRE_BoomerAMGDestroy> cycle_;
};

}  // namespace sluice::solve
