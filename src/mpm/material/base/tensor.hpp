// Small dense algebra of one particle: matrices of nine numbers, row after row, and symmetric ones
// of six: xx, yy, zz, yz, xz, xy. Entries may have any unit; angles are in rad.
#pragma once
#include <array>
#include <cmath>
#include <span>

#include "mpm/material/base/batch_math.hpp"

namespace sluice::mpm {

using Matrix = std::array<double, 9>;
using Symmetric = std::array<double, 6>;
inline constexpr Matrix identity = {1, 0, 0, 0, 1, 0, 0, 0, 1};

// Of one particle (T: double) or of eight (T: Eight).
template <class T>
inline std::array<T, 9> product(const std::array<T, 9>& a, const std::array<T, 9>& b) {
  std::array<T, 9> c{};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      c[3 * i + j] = a[3 * i] * b[j] + a[3 * i + 1] * b[3 + j] + a[3 * i + 2] * b[6 + j];
  return c;
}
template <class T>
inline std::array<T, 9> transposed(const std::array<T, 9>& a) {
  return {a[0], a[3], a[6], a[1], a[4], a[7], a[2], a[5], a[8]};
}
// Of a with det a != 0.
template <class T>
inline std::array<T, 9> inverse(const std::array<T, 9>& a) {
  const T A = a[4] * a[8] - a[5] * a[7], B = a[5] * a[6] - a[3] * a[8],
          C = a[3] * a[7] - a[4] * a[6];
  const T per = 1.0 / (a[0] * A + a[1] * B + a[2] * C);
  return {A * per, (a[2] * a[7] - a[1] * a[8]) * per, (a[1] * a[5] - a[2] * a[4]) * per,
          B * per, (a[0] * a[8] - a[2] * a[6]) * per, (a[2] * a[3] - a[0] * a[5]) * per,
          C * per, (a[1] * a[6] - a[0] * a[7]) * per, (a[0] * a[4] - a[1] * a[3]) * per};
}
template <class T>
inline std::array<T, 9> full(const std::array<T, 6>& S) {
  return {S[0], S[5], S[4], S[5], S[1], S[3], S[4], S[3], S[2]};
}
template <class T>
inline std::array<T, 6> symmetric(const std::array<T, 9>& a) {
  return {a[0], a[4], a[8], 0.5 * (a[5] + a[7]), 0.5 * (a[2] + a[6]), 0.5 * (a[1] + a[3])};
}

template <class T>
inline T trace(const std::array<T, 6>& S) {
  return S[0] + S[1] + S[2];
}
// A : B
template <class T>
inline T double_dot(const std::array<T, 6>& A, const std::array<T, 6>& B) {
  return A[0] * B[0] + A[1] * B[1] + A[2] * B[2] + 2.0 * (A[3] * B[3] + A[4] * B[4] + A[5] * B[5]);
}
template <class T>
inline std::array<T, 6> deviator(std::array<T, 6> S) {
  const T mean = trace(S) * (1.0 / 3);
  S[0] -= mean;
  S[1] -= mean;
  S[2] -= mean;
  return S;
}
// a A + b B
template <class S, class T, class U>
inline std::array<T, 6> combined(const S& a, const std::array<T, 6>& A, const U& b,
                                 const std::array<T, 6>& B) {
  std::array<T, 6> C;
  for (std::size_t k = 0; k < 6; ++k) C[k] = a * A[k] + b * B[k];
  return C;
}

// F = R U.
template <class T>
struct PolarOf {
  std::array<T, 9> R;
  std::array<T, 6> U;
};
using Polar = PolarOf<double>;
// By Newton's method R <- (R + R^-T)/2 (Higham 1986), quadratic, to round-off. det F > 0. The same
// bits alone and among eight.
Polar polar(const Matrix& F);
PolarOf<Eight> polar(const std::array<Eight, 9>& F);
// What the body was strained from U_0 to U_1, whatever it turned: sym[(U_1 - U_0) U_m^-1],
// U_m = (U_0 + U_1)/2; of third order from the integral of D dt in the body's own axes.
template <class T>
inline std::array<T, 6> strain_between(const std::array<T, 6>& U_0, const std::array<T, 6>& U_1) {
  return symmetric(
      product(full(combined(1.0, U_1, -1.0, U_0)), inverse(full(combined(.5, U_0, .5, U_1)))));
}

// Eigenvalues, least first, and unit eigenvectors: vectors[3 k ...] belongs to values[k].
struct Principal {
  std::array<double, 3> values;
  std::array<double, 9> vectors;
};
Principal principal(const Symmetric& S);

// Turned about an axis through the origin, right-handed; the axis need not have length 1.
Matrix rotation(const std::array<double, 3>& axis, double angle);
// exp(a): the deformation after a velocity gradient L over t is exp(t L).
Matrix exponential(const Matrix& a);

}  // namespace sluice::mpm
