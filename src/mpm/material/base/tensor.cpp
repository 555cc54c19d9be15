// Small dense algebra of one particle.
#include "mpm/material/base/tensor.hpp"

#include <algorithm>
#include <Eigen/Eigenvalues>

namespace sluice::mpm {

namespace {

// R <- (R + R^-T)/2 in every lane until it has stopped there, so that a lane knows nothing of the
// others. R: F without its change of volume, which takes fewer steps.
template <class T>
PolarOf<T> turned(const std::array<T, 9>& F) {
  constexpr int max_steps = 40;
  const T scale = inverse_cube_root(determinant(F));
  std::array<T, 9> R;
  for (std::size_t m = 0; m < 9; ++m) R[m] = F[m] * scale;
  T goes = T{} + 1.0;
  for (int step = 0; step < max_steps && sum_of_lanes(goes) != 0; ++step) {
    const std::array<T, 9> old = R, inverted = inverse(old);
    T change{};
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) {
        const T x = old[3 * i + j], next = 0.5 * (x + inverted[3 * j + i]);
        change = larger(change, magnitude(next - x));
        R[3 * i + j] = goes != 0.0 ? next : x;
      }
    // After 3e-8 the step has taken its square of that: round-off.
    goes = change < 3e-8 ? T{} : goes;
  }
  return {R, symmetric(product(transposed(R), F))};
}

}  // namespace

Polar polar(const Matrix& F) {
  return turned(F);
}

PolarOf<Eight> polar(const std::array<Eight, 9>& F) {
  return turned(F);
}

Principal principal(const Symmetric& S) {
  Eigen::Matrix3d full_matrix;
  full_matrix << S[0], S[5], S[4], S[5], S[1], S[3], S[4], S[3], S[2];
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(full_matrix);
  Principal found;
  for (int k = 0; k < 3; ++k) {
    found.values[k] = solver.eigenvalues()[k];
    for (int i = 0; i < 3; ++i) found.vectors[3 * k + i] = solver.eigenvectors()(i, k);
  }
  return found;
}

Matrix rotation(const std::array<double, 3>& axis, double angle) {
  const double size = std::hypot(axis[0], axis[1], axis[2]);
  const double x = axis[0] / size, y = axis[1] / size, z = axis[2] / size;
  const double c = std::cos(angle), s = std::sin(angle), v = 1 - c;
  return {c + v * x * x,     v * x * y - s * z, v * x * z + s * y, v * x * y + s * z, c + v * y * y,
          v * y * z - s * x, v * x * z - s * y, v * y * z + s * x, c + v * z * z};
}

Matrix exponential(const Matrix& a) {
  double size = 0;
  for (double x : a) size = std::max(size, std::abs(x));
  int halvings = 0;
  for (; size > 0.1; size /= 2) ++halvings;
  Matrix scaled = a;
  for (double& x : scaled) x = std::ldexp(x, -halvings);
  Matrix sum = identity, term = identity;
  for (int k = 1; k < 16; ++k) {
    term = product(term, scaled);
    for (double& x : term) x /= k;
    for (std::size_t m = 0; m < 9; ++m) sum[m] += term[m];
  }
  for (int k = 0; k < halvings; ++k) sum = product(sum, sum);
  return sum;
}

}  // namespace sluice::mpm
