// A parabola in a cell, from the means of five cells: where it ends at the two edges, and its means
// over the share of the cell that reaches an edge in a step.
//
// Differences d of neighbouring means (-3/2, -1/2, 1/2, 3/2) and second differences e (-1, 0, 1)
// give edges of fourth order; the rises from the low edge to the mean and from the mean to the
// high edge are
//   low = d_{-1/2}/2 + (e_{-1} + e_0)/12,   high = d_{1/2}/2 - (e_0 + e_1)/12.
// Elsewhere than in smooth flow they are limited: each edge lies between the two means beside it;
// a mean that is an extremum has no rise; |low| <= 2 |high| and |high| <= 2 |low|, which is where
// the parabola would leave the range of its edges (Colella, Woodward, J. Comput. Phys. 54 (1984)
// 174). Flow is smooth where the three second differences have one sign and the largest is at most
// twice the smallest: extrema of waves of more than about eight cells keep their height.
// Odd, and the same to the bit in the mirror: low and high change places with the signs.
#pragma once
#include <cmath>

#include "ice/fluid/limiters.hpp"

namespace sluice::ice {

// threshold: largest ratio of three second differences of one sign where flow is smooth; unit: 1;
//   test: Parabola.KeepsSmoothExtremaAndLimitsSharpOnes
constexpr double max_curvature_ratio = 2.0;

struct Parabola {
  double low = 0, high = 0;  // rises, in the unit of the quantity
};

// Of the differences of the means, from the lowest on.
[[gnu::always_inline]] inline Parabola parabola(double dmm, double dm, double dp, double dpp) {
  const double em = dm - dmm, e0 = dp - dm, ep = dpp - dp;
  const double low = 0.5 * dm + (em + e0) * (1.0 / 12.0);
  const double high = 0.5 * dp - (e0 + ep) * (1.0 / 12.0);
  const double least = smaller(e0, smaller(em, ep)), most = larger(e0, larger(em, ep));
  const bool smooth = (most <= max_curvature_ratio * least) | (least >= max_curvature_ratio * most);
  const double a = smaller(larger(low, smaller(0.0, dm)), larger(0.0, dm));
  const double b = smaller(larger(high, smaller(0.0, dp)), larger(0.0, dp));
  const double limited_low = std::copysign(smaller(std::fabs(a), 2.0 * std::fabs(b)), a);
  const double limited_high = std::copysign(smaller(std::fabs(b), 2.0 * std::fabs(a)), b);
  const bool monotone = a * b > 0.0;
  return {smooth ? low : (monotone ? limited_low : 0.0),
          smooth ? high : (monotone ? limited_high : 0.0)};
}

// Mean over the share s of the cell that ends at the high (low) edge, less the mean of the cell.
[[gnu::always_inline]] inline double mean_at_high_edge(double low, double high, double s) {
  return (1.0 - s) * ((1.0 - s) * high + s * low);
}
[[gnu::always_inline]] inline double mean_at_low_edge(double low, double high, double s) {
  return -((1.0 - s) * ((1.0 - s) * low + s * high));
}

}  // namespace sluice::ice
