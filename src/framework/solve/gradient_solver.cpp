// Conjugate gradients on a window.
#include "framework/solve/gradient_solver.hpp"

namespace sluice::solve {
namespace {

// As many iterations without a new least residual, and the solver stops: round-off.
constexpr int patience = 10;

// to = a + s b over the cells of all rows; ghosts keep what they are.
void combine(const DenseSystem& system, const DenseVector& a, double s, const DenseVector& b,
             DenseVector& to) {
  const int n = system.shape().count[0];
  system.for_rows([&](std::ptrdiff_t row) {
    const double* u = a.data() + row;
    const double* v = b.data() + row;
    double* w = to.data() + row;
#pragma GCC ivdep
    for (int i = 0; i < n; ++i) w[i] = u[i] + s * v[i];
  });
}

}  // namespace

void GradientSolver::prepare(const DenseSystem& system) {
  cycle_ = MultigridCycle(system);
  for (DenseVector* v : {&r_, &z_, &p_, &q_}) system.give_size(*v);
}

LinearSolver::Attempt GradientSolver::attempt(const DenseSystem& system, const DenseVector& b,
                                              DenseVector& x, const Goal& goal) {
  Attempt result;
  system.residual(b, x, r_);
  system.clear(p_);
  double rz = 0, residual = system.norm(r_, settings().norm), least = residual;
  int since_least = 0;
  while (residual > goal.residual) {
    if (result.iterations == goal.max_iterations) {
      result.failure = "the maximum of iterations";
      break;
    }
    cycle_.apply(system, r_, residual, z_);
    const double rz_now = system.dot(r_, z_);
    combine(system, z_, rz > 0 ? rz_now / rz : 0.0, p_, p_);
    rz = rz_now;
    system.apply(p_, q_);
    const double curvature = system.dot(p_, q_);
    if (!(curvature > 0) || !(rz > 0)) {
      result.failure = "the matrix is not positive definite";
      break;
    }
    const double step = rz / curvature;
    combine(system, x, step, p_, x);
    combine(system, r_, -step, q_, r_);
    residual = system.norm(r_, settings().norm);
    ++result.iterations;
    result.residuals.push_back(residual);
    since_least = residual < least ? 0 : since_least + 1;
    least = std::min(least, residual);
    if (since_least == patience) {
      result.failure = "no smaller residual in 10 iterations";
      break;
    }
  }
  return result;
}

}  // namespace sluice::solve
