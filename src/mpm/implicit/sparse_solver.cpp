#include "mpm/implicit/sparse_solver.hpp"

#include <algorithm>
#include <cmath>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

namespace sluice::mpm {
namespace {

using Vector = Eigen::VectorXd;
using Rows = Eigen::Map<const Eigen::SparseMatrix<double, Eigen::RowMajor>>;

constexpr double raised = 1e-8;         // of the diagonal
constexpr double no_stiffness = 1e-14;  // of the largest diagonal: stiffness that is none
constexpr double wanted = 1e-12;        // residual over right-hand side
constexpr double bearable = 1e-5;       // Newton's method gets on with this
constexpr int most_corrections = 60;

}  // namespace

struct SparseSolver::Factor {
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> ldlt;
  std::vector<int> begin, column;  // of the pattern that was analysed

  Vector apply(const Vector& r) const { return ldlt.solve(r); }
};

SparseSolver::SparseSolver() : factor_(std::make_unique<Factor>()) {}
SparseSolver::~SparseSolver() = default;

namespace {

// H. A. van der Vorst, SIAM J. Sci. Stat. Comput. 13 (1992) 631, with right preconditioning; x
// begins at P^-1 b. Keeps the best x.
template <class Precondition>
double bicgstab(const Rows& A, const Vector& b, const Precondition& precondition, Vector& x) {
  const double size = b.norm();
  x = precondition(b);
  Vector r = b - A * x, best = x;
  double least = r.norm() / size;
  const Vector shadow = r;
  Vector p = r, v, s, t;
  double rho = shadow.dot(r);
  for (int n = 0; n < most_corrections && least > wanted; ++n) {
    const Vector hat = precondition(p);
    v = A * hat;
    const double alpha = rho / shadow.dot(v);
    s = r - alpha * v;
    const Vector s_hat = precondition(s);
    t = A * s_hat;
    const double t2 = t.squaredNorm();
    const double omega = t2 > 0 ? t.dot(s) / t2 : 0;
    x += alpha * hat + omega * s_hat;
    r = s - omega * t;
    const double now = r.norm() / size;
    if (!std::isfinite(now)) break;
    if (now < least) {
      least = now;
      best = x;
    }
    const double next = shadow.dot(r);
    if (omega == 0 || rho == 0 || next == 0) break;
    p = r + (next / rho * alpha / omega) * (p - omega * v);
    rho = next;
  }
  x = best;
  return (b - A * x).norm() / size;
}

}  // namespace

SparseRows sparse_rows(const solve::BlockRows& blocks, const std::vector<int>& number) {
  SparseRows rows;
  rows.begin.assign(1, 0);
  const auto w = static_cast<std::size_t>(blocks.width);
  for (std::size_t i = 0; i < blocks.count(); ++i)
    for (std::size_t a = 0; a < w; ++a) {
      if (number[w * i + a] < 0) continue;
      for (std::size_t e = blocks.begin[i]; e < blocks.begin[i + 1]; ++e) {
        const std::size_t j = w * static_cast<std::size_t>(blocks.column[e]);
        for (std::size_t b = 0; b < w; ++b) {
          if (number[j + b] < 0) continue;
          rows.column.push_back(number[j + b]);
          rows.value.push_back(blocks.value[w * w * e + w * a + b]);
        }
      }
      rows.begin.push_back(static_cast<int>(rows.column.size()));
    }
  return rows;
}

bool SparseSolver::solve(const SparseRows& rows, std::span<const double> right_side,
                         std::vector<double>& x) {
  const int n = rows.count();
  indefinite_ = false;
  x.assign(static_cast<std::size_t>(n), 0.0);
  const Vector b = Eigen::Map<const Vector>(right_side.data(), n);
  if (!b.allFinite()) return false;
  if (b.isZero(0)) return true;
  const Rows A(n, n, static_cast<Eigen::Index>(rows.value.size()), rows.begin.data(),
               rows.column.data(), rows.value.data());
  Eigen::SparseMatrix<double> K = A;
  K = 0.5 * (Eigen::SparseMatrix<double>(A.transpose()) + K).eval();
  double most = 0;
  for (int i = 0; i < n; ++i) most = std::max(most, std::fabs(K.coeff(i, i)));
  // Rows without stiffness, of nodes that only failed particles reach: none of them is moved.
  for (int i = 0; i < n; ++i) {
    double& diagonal = K.coeffRef(i, i);
    diagonal = std::fabs(diagonal) > no_stiffness * most ? diagonal * (1 + raised) : most;
  }
  Factor& f = *factor_;
  if (f.begin != rows.begin || f.column != rows.column) {
    f.ldlt.analyzePattern(K);
    f.begin = rows.begin;
    f.column = rows.column;
  }
  f.ldlt.factorize(K);
  if (f.ldlt.info() != Eigen::Success) return false;
  indefinite_ = f.ldlt.vectorD().minCoeff() < 0;
  Vector solution;
  const double residual = bicgstab(
      A, b, [&f](const Vector& r) { return f.apply(r); }, solution);
  if (!solution.allFinite() || !(residual < bearable)) return false;
  std::copy_n(solution.data(), n, x.begin());
  return true;
}

}  // namespace sluice::mpm
