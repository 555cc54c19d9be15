#include "mpm/step/deformation.hpp"

#include <algorithm>
#include <cmath>

#include "mpm/material/base/batch_math.hpp"

namespace sluice::mpm {
namespace {

using Matrix = std::array<double, 9>;

Matrix product(const Matrix& a, const Matrix& b) {
  Matrix c{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      c[3 * i + j] = a[3 * i] * b[j] + a[3 * i + 1] * b[3 + j] + a[3 * i + 2] * b[6 + j];
  return c;
}

Matrix read(const Nine<const double>& from, int p) {
  Matrix m;
  for (std::size_t e = 0; e < 9; ++e) m[e] = from[e][p];
  return m;
}

// I + dt L of a substep, or the series sum (dt L)^k/k!.
Matrix increment(int terms, double dt, const Matrix& L) {
  Matrix sum = {1, 0, 0, 0, 1, 0, 0, 0, 1}, power = sum;
  for (int k = 1; k <= terms; ++k) {
    power = product(L, power);
    for (std::size_t e = 0; e < 9; ++e) {
      power[e] *= dt / k;
      sum[e] += power[e];
    }
  }
  return sum;
}

void deform_one(int order, double dt, const Batch& b, int p) {
  const Matrix L = read(b.L, p);
  Matrix F = read(b.old_F, p);
  if (order < 1) {
    F = product(increment(std::max(1, -order), dt, L), F);
  } else {
    double norm = 0;
    for (const double l : L) norm += l * l;
    const int steps = std::min(10000, std::max(order, 2 * static_cast<int>(std::sqrt(norm) * dt)));
    const Matrix E = increment(1, dt / steps, L);
    for (int s = 0; s < steps; ++s) F = product(E, F);
  }
  for (std::size_t e = 0; e < 9; ++e) const_cast<double*>(b.F[e])[p] = F[e];
}

// The least of 1 and what was added, eight at a time or one; what is no number is passed over.
class Least {
 public:
  void add(double x) { one_ = x < one_ ? x : one_; }
  void add(const Eight& x) { all_ = x < all_ ? x : all_; }
  double value() const {
    double least = one_;
    for (int l = 0; l < 8; ++l) least = all_[l] < least ? all_[l] : least;
    return least;
  }

 private:
  double one_ = 1;
  Eight all_ = Eight{} + 1.0;
};

}  // namespace

int deform(int order, double dt, const Batch& b, double* volume) {
  Nine<double> F;
  for (std::size_t e = 0; e < 9; ++e) F[e] = const_cast<double*>(b.F[e]);
  if (order == 1) {
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) {
        const double *l0 = b.L[3 * i], *l1 = b.L[3 * i + 1], *l2 = b.L[3 * i + 2];
        const double *f = b.old_F[3 * i + j], *f0 = b.old_F[j], *f1 = b.old_F[3 + j],
                     *f2 = b.old_F[6 + j];
        double* to = F[3 * i + j];
#pragma GCC ivdep
        for (int p = 0; p < b.count; ++p)
          to[p] = f[p] + dt * (l0[p] * f0[p] + l1[p] * f1[p] + l2[p] * f2[p]);
      }
  } else {
    for (int p = 0; p < b.count; ++p) deform_one(order, dt, b, p);
  }
  Least least;
  for_eights(0, static_cast<std::size_t>(b.count), [&](auto p) {
    const auto J = determinant(at(F, p));
    p.put(J * p(b.volume_0), volume);
    least.add(J);
  });
  if (least.value() > 0) return -1;
  for (int p = 0; p < b.count; ++p)
    if (!(volume[p] > 0)) return p;
  return -1;
}

}  // namespace sluice::mpm
