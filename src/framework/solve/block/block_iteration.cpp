#include "framework/solve/block/block_iteration.hpp"

#include <algorithm>
#include <cmath>

namespace sluice::solve {
namespace {

using Vector = std::vector<double>;

// r = b - A x.
void residual_of(const LinearMap& A, std::span<const double> b, std::span<const double> x,
                 Vector& r) {
  r.resize(b.size());
  A(x, r);
  for (std::size_t i = 0; i < b.size(); ++i) r[i] = b[i] - r[i];
}

}  // namespace

double weighted_norm(const LinearMap& weight, const Workers& workers, std::span<const double> r) {
  Vector weighted(r.size());
  weight(r, weighted);
  return std::sqrt(std::max(0.0, dot(workers, r, weighted)));
}

BlockReport conjugate_gradients(const LinearMap& A, const LinearMap& preconditioner,
                                const Workers& workers, std::span<const double> b,
                                std::span<double> x, const BlockGoal& goal) {
  BlockReport report;
  const auto norm = [&](std::span<const double> v) {
    return weighted_norm(goal.weight, workers, v);
  };
  report.right_side = norm(b);
  Vector r, z(b.size()), q(b.size());
  residual_of(A, b, x, r);
  report.residual = norm(r);
  preconditioner(r, z);
  Vector p = z;
  double rz = dot(workers, r, z);
  while (!(report.residual <= goal.residual)) {
    if (report.iterations == goal.max_iterations || !std::isfinite(report.residual)) return report;
    A(p, q);
    const double curvature = dot(workers, p, q);
    report.negative_preconditioner = !(rz > 0);
    report.negative_curvature = !(curvature > 0);
    if (report.negative_preconditioner || report.negative_curvature) return report;
    ++report.iterations;
    const double alpha = rz / curvature;
    for (std::size_t i = 0; i < p.size(); ++i) {
      x[i] += alpha * p[i];
      r[i] -= alpha * q[i];
    }
    report.residual = norm(r);
    if (report.residual <= goal.residual) break;
    preconditioner(r, z);
    const double next = dot(workers, r, z), beta = next / rz;
    rz = next;
    for (std::size_t i = 0; i < p.size(); ++i) p[i] = z[i] + beta * p[i];
  }
  report.converged = true;
  return report;
}

BlockReport bicgstab(const LinearMap& A, const LinearMap& preconditioner, const Workers& workers,
                     std::span<const double> b, std::span<double> x, const BlockGoal& goal) {
  BlockReport report;
  const auto norm = [&](std::span<const double> v) {
    return weighted_norm(goal.weight, workers, v);
  };
  report.right_side = norm(b);
  const std::size_t n = b.size();
  Vector r, v(n), s(n), t(n), p_hat(n), s_hat(n), now(x.begin(), x.end());
  residual_of(A, b, now, r);
  const Vector shadow = r;
  Vector p = r;
  double rho = dot(workers, shadow, r);
  report.residual = norm(r);
  while (report.residual > goal.residual && report.iterations < goal.max_iterations) {
    ++report.iterations;
    preconditioner(p, p_hat);
    A(p_hat, v);
    const double alpha = rho / dot(workers, shadow, v);
    for (std::size_t i = 0; i < n; ++i) s[i] = r[i] - alpha * v[i];
    preconditioner(s, s_hat);
    A(s_hat, t);
    const double t2 = dot(workers, t, t), omega = t2 > 0 ? dot(workers, t, s) / t2 : 0;
    for (std::size_t i = 0; i < n; ++i) {
      now[i] += alpha * p_hat[i] + omega * s_hat[i];
      r[i] = s[i] - omega * t[i];
    }
    const double size = norm(r);
    if (!std::isfinite(size)) break;
    if (size < report.residual) {
      report.residual = size;
      std::copy(now.begin(), now.end(), x.begin());
    }
    const double next = dot(workers, shadow, r);
    if (omega == 0 || next == 0) break;
    const double beta = next / rho * alpha / omega;
    for (std::size_t i = 0; i < n; ++i) p[i] = r[i] + beta * (p[i] - omega * v[i]);
    rho = next;
  }
  report.converged = report.residual <= goal.residual;
  return report;
}

}  // namespace sluice::solve
