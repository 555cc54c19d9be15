// Central differences of the velocity in a row of cells, and the rate of strain, 1/s.
#pragma once
#include "ice/step/variables.hpp"

namespace sluice::ice {

template <int D, int C>
class VelocityRows {
 public:
  // by_direction: components are those of the level, else those of the scheme.
  VelocityRows(const Row& row, In velocity, const SchemeOptions& o, bool by_direction) {
    for (int t = 0; t < D; ++t) half_[t] = 0.5 / row.step().spacing[o.grid.axes.direction[t]];
    for (int c = 0; c < C; ++c) {
      const int component = by_direction ? o.grid.direction[c] : c;
      for (int t = 0; t < D; ++t) {
        minus_[c][t] = row(velocity, component, t, -1);
        plus_[c][t] = row(velocity, component, t, 1);
      }
    }
  }

  // du_c/dx_t; none along directions that are no dimension.
  double slope(int c, int t, int i) const {
    return t < D ? (plus_[c][t][i] - minus_[c][t][i]) * half_[t] : 0.0;
  }
  double strain(int a, int b, int i) const { return 0.5 * (slope(a, b, i) + slope(b, a, i)); }
  // 2 S:S, 1/s^2. Carried components apart: no order of two axes shows in the bits.
  double strain_squared(int i) const {
    double along = 0, across = 0, carried = 0;
    for (int a = 0; a < C; ++a) {
      if (a < D) along += slope(a, a, i) * slope(a, a, i);
      for (int b = a + 1; b < C; ++b) {
        const double shear = slope(a, b, i) + slope(b, a, i);
        (b < D ? across : carried) += shear * shear;
      }
    }
    double sum = 2.0 * along;
    if constexpr (D > 1) sum += across;
    if constexpr (C > D) sum += carried;
    return sum;
  }

 private:
  const double* minus_[C][D];
  const double* plus_[C][D];
  double half_[D];
};

}  // namespace sluice::ice
