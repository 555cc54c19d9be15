#include "framework/solve/block/chebyshev.hpp"

#include <algorithm>
#include <cmath>

namespace sluice::solve {
namespace {

constexpr double interval = 8;  // largest over smallest eigenvalue that is damped
constexpr double margin = 1.1;  // of an estimate from below
constexpr int first_products = 12, later_products = 3, careful_products = 60;

}  // namespace

void Chebyshev::set_up(const BlockRows& rows, const Workers& workers, Estimate estimate) {
  rows_.round(rows, workers);
  workers_ = &workers;
  diagonal_.invert(rows);
  const std::size_t n = rows.unknowns();
  change_.resize(n);
  product_.resize(n);
  const bool careful = estimate == Estimate::careful, known = !careful && vector_.size() == n;
  if (!known) {
    // Numbers without a pattern, the same in every run: a linear congruential generator.
    vector_.resize(n);
    std::uint32_t seed = 12345;
    for (double& x : vector_) {
      seed = seed * 1664525U + 1013904223U;
      x = (seed >> 8) / static_cast<double>(1 << 24) - 0.5;
    }
  }
  estimate_largest(careful ? careful_products : known ? later_products : first_products);
}

// v = D^-1 A v/|v|, lmax ~ |v|: the power method.
void Chebyshev::estimate_largest(int products) {
  double size = 0;
  for (int n = 0; n < products; ++n) {
    const double length = std::sqrt(dot(*workers_, vector_, vector_));
    if (!(length > 0)) break;
    for (double& x : vector_) x /= length;
    rows_.multiply(*workers_, vector_, product_);
    diagonal_.apply(*workers_, product_, vector_);
    size = std::sqrt(dot(*workers_, vector_, vector_));
  }
  largest_ = size > 0 && std::isfinite(size) ? margin * size : 1;
  if (!(size > 0) || !std::isfinite(size)) vector_.clear();
}

// From the residual of x on: x += d_0 + d_1 + ..., residual -= A d.
void Chebyshev::run(std::span<double> x, std::span<double> residual, bool last_residual) const {
  const double middle = 0.5 * (largest_ + largest_ / interval),
               half = 0.5 * (largest_ - largest_ / interval), sigma = middle / half;
  double rho = 1 / sigma;
  diagonal_.apply(*workers_, residual, change_);
  for (double& d : change_) d /= middle;
  for (int k = 0;; ++k) {
    for (std::size_t i = 0; i < x.size(); ++i) x[i] += change_[i];
    const bool last = k + 1 == degree;
    if (last && !last_residual) return;
    rows_.multiply(*workers_, change_, product_);
    for (std::size_t i = 0; i < x.size(); ++i) residual[i] -= product_[i];
    if (last) return;
    diagonal_.apply(*workers_, residual, product_);
    const double next = 1 / (2 * sigma - rho), of_change = next * rho,
                 of_residual = 2 * next / half;
    for (std::size_t i = 0; i < x.size(); ++i)
      change_[i] = of_change * change_[i] + of_residual * product_[i];
    rho = next;
  }
}

void Chebyshev::smooth_from_zero(std::span<const double> b, std::span<double> x,
                                 std::span<double> residual) const {
  std::fill(x.begin(), x.end(), 0.0);
  std::copy(b.begin(), b.end(), residual.begin());
  run(x, residual, true);
}

void Chebyshev::smooth(std::span<const double> b, std::span<double> x,
                       std::span<double> scratch) const {
  rows_.multiply(*workers_, x, scratch);
  for (std::size_t i = 0; i < b.size(); ++i) scratch[i] = b[i] - scratch[i];
  run(x, scratch, false);
}

}  // namespace sluice::solve
