// Means of several functions over an interval, by halving where two rules differ.
//
// Lobatto's rule with 4 points (exact to degree 5) and Kronrod's extension of it to 7 (degree 9):
// both use the ends, so that a jump anywhere inside is seen. A half is halved again until the rules
// agree; a jump costs ten points per factor of two.
// Reference: W. Gander and W. Gautschi, Adaptive quadrature - revisited, BIT 40 (2000) 84-101.
#pragma once
#include <array>
#include <cmath>
#include <cstddef>

namespace sluice::exact {

namespace lobatto {

// Places inside [-1, 1], and weights that sum to one; the ends come first, then inward.
inline const double outer = std::sqrt(2.0 / 3), inner = std::sqrt(0.2);
inline constexpr std::array<double, 4> seven = {77.0 / 2940, 432.0 / 2940, 625.0 / 2940,
                                                672.0 / 2940};
inline constexpr std::array<double, 2> four = {1.0 / 12, 5.0 / 12};
inline constexpr int most_halvings = 48;

template <std::size_t n>
using Values = std::array<double, n>;

// Adds `share` times the means over [a, b] to `sum`; f_a and f_b are the values at the ends.
template <std::size_t n, class F, class Differ>
void add_means(F& f, const Differ& differ, double a, double b, const Values<n>& f_a,
               const Values<n>& f_b, double share, int halvings, Values<n>& sum) {
  const double middle = 0.5 * (a + b), half = 0.5 * (b - a);
  const Values<n> f1 = f(middle - outer * half), f2 = f(middle - inner * half), f3 = f(middle),
                  f4 = f(middle + inner * half), f5 = f(middle + outer * half);
  Values<n> mean, difference;
  for (std::size_t k = 0; k < n; ++k) {
    mean[k] = seven[0] * (f_a[k] + f_b[k]) + seven[1] * (f1[k] + f5[k]) +
              seven[2] * (f2[k] + f4[k]) + seven[3] * f3[k];
    difference[k] = share * (mean[k] - four[0] * (f_a[k] + f_b[k]) - four[1] * (f2[k] + f4[k]));
  }
  if (halvings < most_halvings && differ(difference)) {
    add_means<n>(f, differ, a, middle, f_a, f3, 0.5 * share, halvings + 1, sum);
    add_means<n>(f, differ, middle, b, f3, f_b, 0.5 * share, halvings + 1, sum);
    return;
  }
  for (std::size_t k = 0; k < n; ++k) sum[k] += share * mean[k];
}

}  // namespace lobatto

// The means over [a, b] of the n values of f. Where the two rules differ by `difference`, a part is
// halved if differ(difference) says so.
template <std::size_t n, class F, class Differ>
std::array<double, n> adaptive_mean(F&& f, double a, double b, const Differ& differ) {
  std::array<double, n> sum{};
  lobatto::add_means<n>(f, differ, a, b, f(a), f(b), 1.0, 0, sum);
  return sum;
}

}  // namespace sluice::exact
