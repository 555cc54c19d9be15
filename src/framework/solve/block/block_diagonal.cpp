#include "framework/solve/block/block_diagonal.hpp"

#include <cmath>
#include <Eigen/Dense>

namespace sluice::solve {
namespace {

constexpr double no_stiffness = 1e-10;  // of the largest eigenvalue of a block
constexpr std::size_t rows_at_once = 2048;

template <int B>
void invert_block(const double* block, double* inverse) {
  using Matrix = Eigen::Matrix<double, B, B, Eigen::RowMajor>;
  const Eigen::Map<const Matrix> given(block);
  const Matrix half = 0.5 * (given + given.transpose());
  Eigen::Map<Matrix> to(inverse);
  to.setZero();
  const double most = half.trace();
  if (!(most > 0)) return;
  if constexpr (B == 1) {
    to(0, 0) = 1 / half(0, 0);
  } else {
    // All eigenvalues are far enough from 0: det/tr^(B-1) is less than the smallest of them.
    const double det = half.determinant(), size = std::pow(most, B);
    if (det > 10 * no_stiffness * size &&
        (B == 2 || half.template topLeftCorner<2, 2>().determinant() > 0) && half(0, 0) > 0) {
      to = half.inverse();
      return;
    }
    const Eigen::SelfAdjointEigenSolver<Matrix> eigen(half);
    for (int k = 0; k < B; ++k) {
      const double value = eigen.eigenvalues()[k];
      if (!(value > no_stiffness * eigen.eigenvalues()[B - 1])) continue;
      to += eigen.eigenvectors().col(k) * eigen.eigenvectors().col(k).transpose() / value;
    }
  }
}

template <int B>
void apply_rows(const double* inverse, std::size_t first, std::size_t end, const double* x,
                double* y) {
  for (std::size_t i = first; i < end; ++i) {
    const double* v = inverse + static_cast<std::size_t>(B * B) * i;
    const double* q = x + static_cast<std::size_t>(B) * i;
    for (int a = 0; a < B; ++a) {
      double sum = v[B * a] * q[0];
      for (int b = 1; b < B; ++b) sum += v[B * a + b] * q[b];
      y[static_cast<std::size_t>(B) * i + static_cast<std::size_t>(a)] = sum;
    }
  }
}

}  // namespace

void BlockDiagonal::invert(const BlockRows& rows) {
  width_ = rows.width;
  const auto size = static_cast<std::size_t>(width_ * width_);
  inverse_.assign(size * rows.count(), 0.0);
  for (std::size_t i = 0; i < rows.count(); ++i) {
    const double* block = rows.find(i, static_cast<std::int32_t>(i));
    double* inverse = inverse_.data() + size * i;
    if (width_ == 1) invert_block<1>(block, inverse);
    if (width_ == 2) invert_block<2>(block, inverse);
    if (width_ == 3) invert_block<3>(block, inverse);
  }
}

void BlockDiagonal::apply(const Workers& workers, std::span<const double> x,
                          std::span<double> y) const {
  const std::size_t count = x.size() / static_cast<std::size_t>(width_);
  for_pieces(workers, count, rows_at_once, [&](std::size_t first, std::size_t end, int) {
    if (width_ == 1) apply_rows<1>(inverse_.data(), first, end, x.data(), y.data());
    if (width_ == 2) apply_rows<2>(inverse_.data(), first, end, x.data(), y.data());
    if (width_ == 3) apply_rows<3>(inverse_.data(), first, end, x.data(), y.data());
  });
}

void BlockDiagonal::clear_unmoved(std::span<double> x) const {
  const auto w = static_cast<std::size_t>(width_);
  // D^-1 is positive semi-definite: a row is 0 if its diagonal is.
  for (std::size_t i = 0; i < x.size(); ++i)
    if (inverse_[w * w * (i / w) + (w + 1) * (i % w)] == 0) x[i] = 0;
}

}  // namespace sluice::solve
