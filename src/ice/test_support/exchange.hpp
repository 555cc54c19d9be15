// The exact answer of exchange alone: the exponential of a matrix, by scaling and squaring
// (C. Moler and C. Van Loan, SIAM Review 45 (2003) 3, method 3).
#pragma once
#include <cmath>
#include <cstddef>
#include <vector>

namespace sluice::ice::mixture {

using Numbers = std::vector<double>;
using Matrix = std::vector<Numbers>;

inline Matrix product(const Matrix& a, const Matrix& b) {
  Matrix c(a.size(), Numbers(a.size(), 0.0));
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t k = 0; k < a.size(); ++k)
      for (std::size_t j = 0; j < a.size(); ++j) c[i][j] += a[i][k] * b[k][j];
  return c;
}

inline Matrix exponential(Matrix a) {
  constexpr int terms = 18;  // (1/2)^18 / 18! is far below round-off
  double norm = 0;
  for (const Numbers& row : a) {
    double sum = 0;
    for (const double x : row) sum += std::fabs(x);
    norm = std::fmax(norm, sum);
  }
  int squarings = 0;
  for (; norm > .5; norm *= .5) ++squarings;
  for (Numbers& row : a)
    for (double& x : row) x = std::ldexp(x, -squarings);
  Matrix sum(a.size(), Numbers(a.size(), 0.0));
  for (std::size_t i = 0; i < a.size(); ++i) sum[i][i] = 1;
  const Matrix unit = sum;
  for (int n = terms; n > 0; --n) {  // Horner: 1 + a/1 (1 + a/2 (1 + ...))
    sum = product(a, sum);
    for (std::size_t i = 0; i < a.size(); ++i)
      for (std::size_t j = 0; j < a.size(); ++j) sum[i][j] = sum[i][j] / n + unit[i][j];
  }
  for (int n = 0; n < squarings; ++n) sum = product(sum, sum);
  return sum;
}

// v after the time 1 of C_m dv_m/dt = sum_n k_mn (v_n - v_m) + push_m.
inline Numbers exchanged(const Numbers& C, const Matrix& k, const Numbers& v,
                         const Numbers& push = {}) {
  const std::size_t n = C.size();
  Matrix rates(n + 1, Numbers(n + 1, 0.0));  // the push as a value that stays 1
  for (std::size_t m = 0; m < n; ++m) {
    if (!push.empty()) rates[m][n] = push[m] / C[m];
    for (std::size_t other = 0; other < n; ++other) {
      if (other == m) continue;
      rates[m][other] = k[m][other] / C[m];
      rates[m][m] -= k[m][other] / C[m];
    }
  }
  const Matrix passed = exponential(rates);
  Numbers after(n, 0.0);
  for (std::size_t m = 0; m < n; ++m) {
    for (std::size_t other = 0; other < n; ++other) after[m] += passed[m][other] * v[other];
    after[m] += passed[m][n];
  }
  return after;
}

inline double farthest(const Numbers& a, const Numbers& b) {
  double most = 0;
  for (std::size_t m = 0; m < a.size(); ++m) most = std::fmax(most, std::fabs(a[m] - b[m]));
  return most;
}

}  // namespace sluice::ice::mixture
