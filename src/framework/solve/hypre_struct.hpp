// The solvers of hypre's Struct interface: SMG, PFMG, SparseMSG, Jacobi, and CG, GMRES, BiCGSTAB
// and the hybrid one with a preconditioner.
//
// The window is given to hypre as one box a rank, whatever the level's boxes are: many boxes make
// it several times slower. Results have the same bits on the same number of ranks.
#pragma once
#include <HYPRE_struct_ls.h>

#include "framework/solve/hypre_tools.hpp"
#include "framework/solve/linear_solver.hpp"

namespace sluice::solve {

// The functions of one method; all have the same form.
struct StructMethod {
  using Solver = HYPRE_StructSolver;
  using Work = HYPRE_Int (*)(Solver, HYPRE_StructMatrix, HYPRE_StructVector, HYPRE_StructVector);
  using Precondition = HYPRE_Int (*)(Solver, HYPRE_PtrToStructSolverFcn, HYPRE_PtrToStructSolverFcn,
                                     Solver);
  const char* name;
  HYPRE_Int (*create)(MPI_Comm, Solver*);
  HYPRE_Int (*destroy)(Solver);
  Work set_up, solve;
  HYPRE_Int (*set_tolerance)(Solver, HYPRE_Real);
  HYPRE_Int (*set_iterations)(Solver, HYPRE_Int);
  HYPRE_Int (*iterations)(Solver, HYPRE_Int*);
  HYPRE_Int (*start_from_zero)(Solver);  // none: not a preconditioner
  Precondition precondition;             // none: takes no preconditioner
};

// By its name in decks; InputError for another one.
const StructMethod& struct_method(const std::string& name);

// A preconditioner of a singular system: without the mean of what it returns, which else grows
// until it hides the residual.
struct MeanFree {
  HYPRE_StructVector ones = nullptr;  // 1 in every unknown
  double unknowns = 0;                // how many
  StructMethod::Work set_up = nullptr, solve = nullptr;
  HYPRE_StructSolver solver = nullptr;
};

// A solver object with its parameters; owns its preconditioner.
class StructWorker {
 public:
  // `mean_free`: what a preconditioner of a singular system needs; no ones: not singular.
  StructWorker(const StructMethod& method, const SolverSettings& settings, bool preconditions,
               const MeanFree& mean_free = {});
  ~StructWorker();
  StructWorker(const StructWorker&) = delete;
  StructWorker& operator=(const StructWorker&) = delete;

  HYPRE_StructSolver get() const { return solver_; }
  const StructMethod& method() const { return method_; }

 private:
  void set_parameters(const SolverSettings& settings);
  void add_preconditioner(const SolverSettings& settings);
  void precondition_by(StructMethod::Work set_up, StructMethod::Work solve,
                       HYPRE_StructSolver solver);

  const StructMethod& method_;
  HYPRE_StructSolver solver_ = nullptr;
  std::unique_ptr<StructWorker> preconditioner_;
  MeanFree mean_free_;
};

class HypreStructSolver : public LinearSolver {
 public:
  explicit HypreStructSolver(const SolverSettings& settings);

 private:
  void prepare(const DenseSystem& system) override;
  // SMG mixes what it took of the old matrix with the new one, and diverges.
  bool can_renew() const override;
  void renew(const DenseSystem& system) override;
  Attempt attempt(const DenseSystem& system, const DenseVector& b, DenseVector& x,
                  const Goal& goal) override;
  void make_worker();
  void make_matrix();
  void fill_matrix(const DenseSystem& system);
  void put(HYPRE_StructVector to, const DenseVector& v);

  const StructMethod& method_;
  Slab slab_;
  HypreObject<HYPRE_StructGrid, HYPRE_StructGridDestroy> grid_;
  HypreObject<HYPRE_StructStencil, HYPRE_StructStencilDestroy> stencil_;
  HypreObject<HYPRE_StructMatrix, HYPRE_StructMatrixDestroy> matrix_;
  HypreObject<HYPRE_StructVector, HYPRE_StructVectorDestroy> b_, x_, ones_;
  std::unique_ptr<StructWorker> worker_;
  MeanFree mean_free_;
  std::vector<double> numbers_;  // of the slab
};

}  // namespace sluice::solve
