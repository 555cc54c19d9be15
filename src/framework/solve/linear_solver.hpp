// What every linear solver offers, and what is checked around each: before it, that the system is
// one; after it, what is left of it.
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
  // From the x given. `b` is not 0 everywhere, and has no mean if the system is singular.
  virtual Attempt attempt(const DenseSystem& system, const DenseVector& b, DenseVector& x,
                          const Goal& goal) = 0;
  void iterate(DenseVector& x, const Goal& goal, SolveReport& report);

  SolverSettings settings_;
  std::optional<DenseSystem> system_;
  DenseVector b_, x_, r_, kept_;
  double set_up_seconds_ = 0;
};

// Throws InputError with every fault of the settings, a line each.
std::unique_ptr<LinearSolver> make_linear_solver(const SolverSettings& settings);

}  // namespace sluice::solve
