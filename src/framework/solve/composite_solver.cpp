#include "framework/solve/composite_solver.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cmath>

#include "framework/solve/composite_amg.hpp"
#include "framework/solve/system_watch.hpp"

namespace sluice::solve {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

constexpr int patience = 10;  // iterations without a new least residual: round-off

// to = a + s b.
void combine(const CompositeVector& a, double s, const CompositeVector& b, CompositeVector& to) {
  for (std::size_t l = 0; l < a.size(); ++l) {
    const double *u = a[l].data(), *v = b[l].data();
    double* w = to[l].data();
    const auto n = static_cast<std::ptrdiff_t>(a[l].size());
#pragma GCC ivdep
    for (std::ptrdiff_t c = 0; c < n; ++c) w[c] = u[c] + s * v[c];
  }
}

void clear(CompositeVector& v) {
  for (DenseVector& of_level : v) std::fill(of_level.begin(), of_level.end(), 0.0);
}

}  // namespace

bool takes_amg_on_levels(const SolverSettings& s) {
  return s.type == "hypreamr" || (s.type == "hypre" && s.solver == "amg");
}

CompositeSolver::CompositeSolver(const SolverSettings& settings) : settings_(settings) {}
CompositeSolver::~CompositeSolver() = default;

void CompositeSolver::set_up(std::span<const LevelCoefficients> levels) {
  const auto start = Clock::now();
  system_ = std::make_unique<CompositeSystem>(levels);
  if (LinearSystemObserver* watch = LinearSystemObserver::current())
    watch->matrix(levels, settings_);
  cycles_.clear();
  amg_.reset();
  if (takes_amg_on_levels(settings_))
    amg_ = std::make_unique<CompositeAmg>(*system_);
  else
    for (std::size_t l = 0; l < system_->levels(); ++l) cycles_.emplace_back(system_->whole(l));
  for (CompositeVector* v : {&r_, &z_, &p_, &q_, &rest_, &gathered_, &correction_})
    *v = system_->vector();
  set_up_seconds_ = seconds_since(start);
}

// One level for what is left, and what is left then.
void CompositeSolver::correct_level(std::size_t level, CompositeVector& rest, CompositeVector& z) {
  system_->gather(rest, level, gathered_);
  const double norm = system_->whole(level).norm(gathered_[level], Norm::largest);
  if (!(norm > 0)) return;
  clear(correction_);
  cycles_[level].apply(system_->whole(level), gathered_[level], norm, correction_[level]);
  system_->spread(correction_, level);
  system_->clear_covered(correction_);
  // What is constant above a coarse cell costs `ratio` times the energy of what is smooth: beyond
  // twice, the cycle would not be positive.
  const double share = system_->step_share(level);
  combine(z, share, correction_, z);
  system_->apply(correction_, q_);
  combine(rest, -share, q_, rest);
}

void CompositeSolver::precondition(const CompositeVector& r, CompositeVector& z) {
  if (amg_ != nullptr) return amg_->apply(r, z);
  clear(z);
  rest_ = r;
  for (std::size_t l = system_->levels(); l-- > 0;) correct_level(l, rest_, z);
  for (std::size_t l = 1; l < system_->levels(); ++l) correct_level(l, rest_, z);
}

SolveReport CompositeSolver::solve(const CompositeVector& b, CompositeVector& x) {
  const auto start = Clock::now();
  SolveReport report;
  report.set_up_seconds = set_up_seconds_;
  if (LinearSystemObserver* watch = LinearSystemObserver::current()) watch->right_side(b);
  clear(x);
  r_ = b;
  report.right_side = system_->norm(b, settings_.norm);
  const double goal =
      std::max(settings_.tolerance * report.right_side, settings_.absolute_tolerance);
  double residual = report.right_side, least = residual, rz = 0;
  report.residuals.push_back(residual);
  clear(p_);
  int since_least = 0;
  while (residual > goal && report.reason.empty()) {
    if (report.iterations == settings_.max_iterations) {
      report.reason = "the maximum of iterations";
      break;
    }
    precondition(r_, z_);
    const double rz_now = system_->dot(r_, z_);
    combine(z_, rz > 0 ? rz_now / rz : 0.0, p_, p_);
    rz = rz_now;
    system_->apply(p_, q_);
    const double curvature = system_->dot(p_, q_);
    if (!(curvature > 0) || !(rz > 0)) {
      report.reason = "the matrix is not positive definite";
      break;
    }
    combine(x, rz / curvature, p_, x);
    combine(r_, -rz / curvature, q_, r_);
    residual = system_->norm(r_, settings_.norm);
    ++report.iterations;
    report.residuals.push_back(residual);
    since_least = residual < least ? 0 : since_least + 1;
    least = std::min(least, residual);
    if (since_least == patience) report.reason = "no smaller residual in 10 iterations";
  }
  // What is left, computed anew.
  system_->apply(x, q_);
  combine(b, -1.0, q_, r_);
  residual = system_->norm(r_, settings_.norm);
  report.residuals.push_back(residual);
  report.converged = residual <= 2.0 * goal;
  if (report.converged)
    report.reason.clear();
  else
    report.reason =
        fmt::format("residual {:.3g} after {} iterations, {:.3g} wanted: {}", residual,
                    report.iterations, goal, report.reason.empty() ? "round-off" : report.reason);
  report.solve_seconds = seconds_since(start);
  return report;
}

}  // namespace sluice::solve
