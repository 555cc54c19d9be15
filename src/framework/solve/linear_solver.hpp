// What every linear solver offers, and what is checked around each: before it, that the system is
// one; after it, what is left of it. Units as in cell_matrix.hpp; norms have that of b.
#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "framework/solve/dense_system.hpp"

namespace sluice::solve {

struct SolveReport {
  int iterations = 0;
  std::vector<double>
      residuals;          // norms; first before, last after all iterations, as computed anew
  double right_side = 0;  // norm of the right-hand side, without its mean if singular
  bool converged = false;
  std::string reason;  // why not
  double set_up_seconds = 0, solve_seconds = 0;
};

class LinearSolver {
 public:
  explicit LinearSolver(const SolverSettings& settings) : settings_(settings) {}
  virtual ~LinearSolver() = default;
  LinearSolver(const LinearSolver&) = delete;
  LinearSolver& operator=(const LinearSolver&) = delete;

  // Collective, as solve(). Throws PhysicsError that names a cell whose row is not valid. The
  // matrix is copied; its level must stay.
  void set_up(const CellMatrix& matrix);
  // The same for the next of a series of matrices of one level: what the solver built of an earlier
  // one serves on while the coefficients drift little and iterations do not grow, where the solver
  // can (hypre's: their bits depend on which matrices came before).
  void follow(const CellMatrix& matrix);
  int times_built() const { return times_built_; }
  // `x` holds where to begin, then the solution, finite even where it has not converged. Throws
  // PhysicsError that names a cell whose right-hand side or start is not finite. Of a singular
  // system the solution whose mean is 0, for the right-hand side without its mean.
  SolveReport solve(const ConstBoxViews& right_side, const BoxViews& x);

 protected:
  struct Goal {
    double residual;  // norm, at most
    int max_iterations;
  };
  struct Attempt {
    int iterations = 0;
    std::vector<double> residuals;  // between iterations, where they are known
    std::string failure;            // why it ended, unless because the goal was met
  };
  const SolverSettings& settings() const { return settings_; }

 private:
  virtual void prepare(const DenseSystem& system) = 0;
  // Can it take new coefficients without being prepared for them, by renew()?
  virtual bool can_renew() const { return false; }
  virtual void renew(const DenseSystem&) {}
  bool serves(const DenseSystem& system) const;
  void build(const DenseSystem& system);
  // From the x given. `b` is not 0 everywhere, and has no mean if the system is singular.
  virtual Attempt attempt(const DenseSystem& system, const DenseVector& b, DenseVector& x,
                          const Goal& goal) = 0;
  void iterate(DenseVector& x, const Goal& goal, SolveReport& report);

  SolverSettings settings_;
  std::optional<DenseSystem> system_;
  DenseVector b_, x_, r_, kept_;
  double set_up_seconds_ = 0;
  // Of what serves: the diagonal that it was built of, the systems it has served, and the
  // iterations that its first solve took (none: not known yet).
  DenseVector built_of_;
  int served_ = 0, times_built_ = 0;
  std::optional<int> first_iterations_;
  bool worn_ = false;  // iterations have grown
};

// Throws InputError with every fault of the settings, a line each.
std::unique_ptr<LinearSolver> make_linear_solver(const SolverSettings& settings);
// Starts what the solver's library needs (MPI, hypre), which takes a quarter of a second; else the
// first solver does.
void start_library(const SolverSettings& settings);

}  // namespace sluice::solve
