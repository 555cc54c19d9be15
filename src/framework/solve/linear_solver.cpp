// Checks and the recomputed residual around a solver; the solvers by name.
#include "framework/solve/linear_solver.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cmath>

#include "framework/base/error.hpp"
#include "framework/base/text.hpp"
#include "framework/solve/gradient_solver.hpp"
#include "framework/solve/hypre_amg.hpp"
#include "framework/solve/hypre_struct.hpp"
#include "framework/solve/hypre_tools.hpp"
#include "framework/solve/system_watch.hpp"

namespace sluice::solve {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// A solver whose own residual met the goal while the true one does not may go on this often.
constexpr int max_attempts = 4;
// Of a diagonal, relative, at which a solver is built anew; and how iterations may grow before.
constexpr double max_drift = 0.1;
bool have_grown(int iterations, int first) {
  return iterations > first + first / 2 + 2;
}

}  // namespace

void LinearSolver::set_up(const CellMatrix& matrix) {
  worn_ = true;
  follow(matrix);
}

void LinearSolver::follow(const CellMatrix& matrix) {
  const auto start = Clock::now();
  std::optional<DenseSystem> before;
  if (can_renew() && !worn_) before = std::move(system_);
  system_.reset();  // none, if this one fails
  DenseSystem system(matrix);
  if (LinearSystemObserver* watch = LinearSystemObserver::current())
    watch->matrix(matrix, settings_);
  if (before && system.is_like(*before) && serves(system))
    renew(system);
  else
    build(system);
  ++served_;
  for (DenseVector* v : {&b_, &x_, &r_, &kept_}) system.give_size(*v);
  system_ = std::move(system);
  set_up_seconds_ = seconds_since(start);
}

void LinearSolver::build(const DenseSystem& system) {
  worn_ = true;  // if it fails
  prepare(system);
  if (can_renew()) built_of_ = system.diagonal();
  served_ = 0;
  first_iterations_.reset();
  worn_ = false;
  ++times_built_;
}

// Collective.
bool LinearSolver::serves(const DenseSystem& system) const {
  if (settings_.set_up_every > 0 && served_ >= settings_.set_up_every) return false;
  double drift = 0;
  system.for_cells([&](std::size_t c) {
    drift = std::max(drift, std::fabs(system.diagonal()[c] - built_of_[c]) / built_of_[c]);
  });
  return system.slabs().largest(drift) <= max_drift;
}

// Attempts until the true residual meets the goal, a solver gives up or nothing improves.
void LinearSolver::iterate(DenseVector& x, const Goal& goal, SolveReport& report) {
  double before = report.residuals.back();
  for (int n = 0; n < max_attempts && before > goal.residual; ++n) {
    const Goal rest{goal.residual, goal.max_iterations - report.iterations};
    if (rest.max_iterations < 1) break;
    system_->copy(x, kept_);
    const Attempt attempt = this->attempt(*system_, b_, x, rest);
    report.iterations += attempt.iterations;
    report.residuals.insert(report.residuals.end(), attempt.residuals.begin(),
                            attempt.residuals.end());
    report.reason = attempt.failure;
    if (system_->singular()) system_->remove_mean(x);
    system_->residual(b_, x, r_);
    double now = system_->norm(r_, settings_.norm);
    if (!std::isfinite(now)) {
      system_->copy(kept_, x);
      report.reason = "the solver's result is not finite";
      report.residuals.push_back(before);
      return;
    }
    report.residuals.push_back(now);
    const bool gains = now < 0.5 * before;
    before = now;
    if (!attempt.failure.empty() || !gains) break;
  }
}

SolveReport LinearSolver::solve(const ConstBoxViews& right_side, const BoxViews& x) {
  if (!system_) throw PhysicsError("linear system: no system is set up");
  const auto start = Clock::now();
  SolveReport report;
  report.set_up_seconds = set_up_seconds_;
  system_->load(right_side, b_);
  system_->need_finite(b_, "right-hand side");
  system_->load({x.begin(), x.end()}, x_);
  system_->need_finite(x_, "start");
  if (LinearSystemObserver* watch = LinearSystemObserver::current())
    watch->right_side(right_side, {x.begin(), x.end()});
  if (system_->singular()) system_->remove_mean(b_);
  report.right_side = system_->norm(b_, settings_.norm);
  const Goal goal{std::max(settings_.tolerance * report.right_side, settings_.absolute_tolerance),
                  settings_.max_iterations};
  if (report.right_side == 0) system_->clear(x_);
  if (system_->singular()) system_->remove_mean(x_);
  system_->residual(b_, x_, r_);
  report.residuals.push_back(system_->norm(r_, settings_.norm));
  iterate(x_, goal, report);
  if (report.residuals.back() > goal.residual && served_ > 1) {  // by what is not of this matrix
    build(*system_);
    served_ = 1;
    system_->load({x.begin(), x.end()}, x_);
    if (system_->singular()) system_->remove_mean(x_);
    iterate(x_, {goal.residual, goal.max_iterations + report.iterations}, report);
  }
  worn_ = have_grown(report.iterations, first_iterations_.value_or(report.iterations));
  if (!first_iterations_) first_iterations_ = report.iterations;
  const double left = report.residuals.back();
  report.converged = left <= goal.residual;
  if (report.converged) {
    report.reason.clear();
  } else {
    if (report.reason.empty()) report.reason = "no further gain: round-off";
    report.reason = fmt::format("residual {:.3g} after {} iterations, {:.3g} wanted: {}", left,
                                report.iterations, goal.residual, report.reason);
  }
  system_->store(x_, x);
  report.solve_seconds = seconds_since(start);
  return report;
}

std::unique_ptr<LinearSolver> make_linear_solver(const SolverSettings& settings) {
  if (const auto faults = faults_of(settings); !faults.empty())
    throw InputError(join(faults, "\n"));
  if (settings.type == "CGSolver") return std::make_unique<GradientSolver>(settings);
  if (settings.type == "hypreamr" || settings.solver == "amg")
    return std::make_unique<HypreAmgSolver>(settings);
  return std::make_unique<HypreStructSolver>(settings);
}

void start_library(const SolverSettings& settings) {
  if (settings.type != "CGSolver") start_hypre();
}

}  // namespace sluice::solve
