// Arithmetic of laws over batches: straight-line functions of numbers that compilers turn into
// vectors, so no branch, no table, no call of the mathematical library. J, F and B have no unit,
// stresses are in Pa.
#pragma once
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

#include "framework/base/eight.hpp"
#include "mpm/material/base/material.hpp"

namespace sluice::mpm {

// Bits of a number, or of eight, and back.
inline std::uint64_t as_whole(double x) {
  return std::bit_cast<std::uint64_t>(x);
}
inline EightBits as_whole(const Eight& x) {
  return reinterpret_cast<EightBits>(x);
}
inline double from_whole(std::uint64_t x) {
  return std::bit_cast<double>(x);
}
inline Eight from_whole(const EightBits& x) {
  return reinterpret_cast<Eight>(x);
}

// x^(-1/3) for x > 0, within 2 units in the last place; some number for other x.
template <class T>
inline T inverse_cube_root(const T& x) {
  // A third of the logarithm, read off the bits; the shift by 12 makes them exact as a number.
  constexpr double two_52 = 4503599627370496.0;
  const T scaled = from_whole((as_whole(x) >> 12) | 0x4330000000000000ull) - two_52;  // bits / 2^12
  constexpr double middle = 4.0 / 3 * 1099511627776.0 * (1023 - 0.045);  // .045: mean error
  const T third = (middle - scaled * (1.0 / 3.0)) + two_52;
  T y = from_whole((as_whole(third) & 0xfffffffffffffull) << 12);
  // Two steps of order four: the error .05 becomes 1e-6, then none.
  for (int k = 0; k < 2; ++k) {
    const T r = 1.0 - x * y * y * y;
    y += y * r * (1.0 / 3 + r * (2.0 / 9 + r * (14.0 / 81)));
  }
  return y;
}

// ln J and (J^2 - 1)/2 - ln J, the latter without cancellation near J = 1. For J > 0.
struct VolumeLogs {
  double ln;
  double energy;
};
inline VolumeLogs volume_logs(double J) {
  // J = 2^e m with m in [sqrt(1/2), sqrt 2); ln m = 2 atanh s, s = (m - 1)/(m + 1).
  constexpr std::uint64_t lowest = 0x3FE6A09E667F3BCDull;  // sqrt(1/2)
  constexpr std::uint64_t one = 0x3FF0000000000000ull;
  const std::uint64_t shifted = std::bit_cast<std::uint64_t>(J) - lowest + one;
  const double e =
      std::bit_cast<double>((shifted >> 52) | 0x4330000000000000ull) - (4503599627370496.0 + 1023);
  const double m = std::bit_cast<double>((shifted & 0xfffffffffffffull) + lowest);
  const double s = (m - 1) / (m + 1), t = s * s;
  double q = 1.0 / 23;
  q = q * t + 1.0 / 21;
  q = q * t + 1.0 / 19;
  q = q * t + 1.0 / 17;
  q = q * t + 1.0 / 15;
  q = q * t + 1.0 / 13;
  q = q * t + 1.0 / 11;
  q = q * t + 1.0 / 9;
  q = q * t + 1.0 / 7;
  q = q * t + 1.0 / 5;
  q = q * t + 1.0 / 3;
  constexpr double ln2 = 0.69314718055994530942;
  const double tail = 2 * s * t * q, d = J - 1;
  const double head = e == 0 ? d * s : d - 2 * s - e * ln2;  // d - (2 s + e ln 2)
  return {e * ln2 + 2 * s + tail, 0.5 * d * d + head - tail};
}

// T: double of one particle, Eight of eight.
template <class T>
inline T determinant(const std::array<T, 9>& F) {
  return F[0] * (F[4] * F[8] - F[5] * F[7]) - F[1] * (F[3] * F[8] - F[5] * F[6]) +
         F[2] * (F[3] * F[7] - F[4] * F[6]);
}

// F of particle i; the columns as a copy in the loop's function, that their addresses are kept.
inline std::array<double, 9> at(const Nine<const double>& F, int i) {
  return {F[0][i], F[1][i], F[2][i], F[3][i], F[4][i], F[5][i], F[6][i], F[7][i], F[8][i]};
}
inline std::array<double, 6> at(const Six<const double>& s, int i) {
  return {s[0][i], s[1][i], s[2][i], s[3][i], s[4][i], s[5][i]};
}
// Of the particles of OneOf or EightOf.
template <class D, std::size_t N, class P>
inline std::array<typename P::Number, N> at(const std::array<D*, N>& columns, const P& particles) {
  std::array<typename P::Number, N> all;
  for (std::size_t n = 0; n < N; ++n) all[n] = particles(columns[n]);
  return all;
}
inline void put(const Six<double>& s, int i, const std::array<double, 6>& values) {
  s[0][i] = values[0];
  s[1][i] = values[1];
  s[2][i] = values[2];
  s[3][i] = values[3];
  s[4][i] = values[4];
  s[5][i] = values[5];
}

// F F^T as xx, yy, zz, yz, xz, xy.
template <class T>
inline std::array<T, 6> left_cauchy_green(const std::array<T, 9>& F) {
  return {F[0] * F[0] + F[1] * F[1] + F[2] * F[2], F[3] * F[3] + F[4] * F[4] + F[5] * F[5],
          F[6] * F[6] + F[7] * F[7] + F[8] * F[8], F[3] * F[6] + F[4] * F[7] + F[5] * F[8],
          F[0] * F[6] + F[1] * F[7] + F[2] * F[8], F[0] * F[3] + F[1] * F[4] + F[2] * F[5]};
}

// R S R^T of a symmetric S: turned by a rotation, or pushed forward.
template <class T>
inline std::array<T, 6> pushed(const std::array<T, 6>& S, const std::array<T, 9>& R) {
  const T a0 = R[0] * S[0] + R[1] * S[5] + R[2] * S[4];
  const T a1 = R[0] * S[5] + R[1] * S[1] + R[2] * S[3];
  const T a2 = R[0] * S[4] + R[1] * S[3] + R[2] * S[2];
  const T b0 = R[3] * S[0] + R[4] * S[5] + R[5] * S[4];
  const T b1 = R[3] * S[5] + R[4] * S[1] + R[5] * S[3];
  const T b2 = R[3] * S[4] + R[4] * S[3] + R[5] * S[2];
  const T c0 = R[6] * S[0] + R[7] * S[5] + R[8] * S[4];
  const T c1 = R[6] * S[5] + R[7] * S[1] + R[8] * S[3];
  const T c2 = R[6] * S[4] + R[7] * S[3] + R[8] * S[2];
  return {a0 * R[0] + a1 * R[1] + a2 * R[2], b0 * R[3] + b1 * R[4] + b2 * R[5],
          c0 * R[6] + c1 * R[7] + c2 * R[8], b0 * R[6] + b1 * R[7] + b2 * R[8],
          a0 * R[6] + a1 * R[7] + a2 * R[8], a0 * R[3] + a1 * R[4] + a2 * R[5]};
}

// No eigenvalue of a symmetric matrix is further from their mean than this: 2 sqrt(J2 / 3), exact
// where two of them are equal; without the cosine of its angle.
template <class T>
inline T eigenvalue_reach(const std::array<T, 6>& s, const T& mean) {
  const T a = s[0] - mean, b = s[1] - mean, c = s[2] - mean;
  const T J2 = 0.5 * (a * a + b * b + c * c) + s[3] * s[3] + s[4] * s[4] + s[5] * s[5];
  return 2.0 * square_root(J2 * (1.0 / 3));
}

// (1 + alpha (T - T_room))^3: volume of the free body at T over that at T_room; 1/K and K.
inline double thermal_volume(double alpha, double T, double T_room) {
  const double stretch = 1 + alpha * (T - T_room);
  return stretch * stretch * stretch;
}

// The first particle with det F <= 0 or not finite.
std::optional<BatchFault> fault_of_volume(const Batch& batch);

}  // namespace sluice::mpm
