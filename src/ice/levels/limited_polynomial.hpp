// The polynomial by which a coarse cell is divided: its functions, averaged over the fine cells,
// and how far data that are not smooth may bend it (prolonger.hpp has the formulae).
#pragma once
#include <cmath>

#include "ice/fluid/limiters.hpp"
#include "ice/levels/children.hpp"

namespace sluice::ice {

constexpr int pair_axes[3][2] = {{0, 1}, {0, 2}, {1, 2}};

// How much curvature the differences a and b of a cell allow, in their unit.
inline double smoothness(double a, double b) {
  const double least = smaller(std::fabs(a), std::fabs(b));
  const double most = larger(std::fabs(a), std::fabs(b));
  return a * b > 0.0 ? larger(0.0, 2.0 * least - most) : 0.0;
}

inline double bounded(double x, double bound) {
  return std::copysign(smaller(std::fabs(x), bound), x);
}

// The polynomial's functions, averaged over each fine cell: D slopes, for order 2 also D curvatures
// and D (D - 1)/2 cross terms.
template <int D, int Order>
struct PolynomialBasis {
  static constexpr int pairs = Order == 2 ? D * (D - 1) / 2 : 0;
  static constexpr int curves = Order == 2 ? D : 0;
  static constexpr int terms = D + curves + pairs;

  explicit PolynomialBasis(const Children& children) {
    for (double& m : most) m = 0;
    for (int child = 0; child < children.count(); ++child) {
      double* f = value[child];
      for (int a = 0; a < D; ++a) {
        const double x = children.offset(child, a), r = children.ratio(a);
        f[a] = x;
        if constexpr (Order == 2) f[D + a] = 0.5 * (x * x - (1.0 - 1.0 / (r * r)) / 12.0);
      }
      for (int p = 0; p < pairs; ++p) f[2 * D + p] = f[pair_axes[p][0]] * f[pair_axes[p][1]];
      for (int k = 0; k < terms; ++k) most[k] = larger(most[k], std::fabs(f[k]));
    }
  }

  // Sum of a polynomial's products `term(k)`, each a function with its factor. Two axes may be
  // exchanged without a trace in the bits.
  template <class Term>
  [[gnu::always_inline]] static double sum(Term&& term) {
    double sum = term(0);
    for (int a = 1; a < D; ++a) sum += term(a);
    if constexpr (Order == 2) {
      double curved = term(D);
      for (int a = 1; a < D; ++a) curved += term(D + a);
      sum += curved;
    }
    for (int p = 0; p < pairs; ++p) sum += term(2 * D + p);
    return sum;
  }

  // By child and term, and the largest of all children; lengths in coarse cells, so without unit.
  double value[Children::max_in(D)][terms];
  double most[terms];
};

}  // namespace sluice::ice
