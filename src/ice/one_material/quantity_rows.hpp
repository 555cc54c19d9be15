// Rows of one quantity, in its unit, in a cell and its neighbours along every axis.
#pragma once
#include "framework/task/row.hpp"

namespace sluice::ice {

struct Quantity {
  const double* minus[3];
  const double* centre;
  const double* plus[3];

  // Differences to the cell before and to the one after along axis t.
  double before(int t, int i) const { return centre[i] - minus[t][i]; }
  double after(int t, int i) const { return plus[t][i] - centre[i]; }

  template <int D>
  Quantity from(int first) const {
    Quantity q;
    q.centre = centre + first;
    for (int t = 0; t < D; ++t) {
      q.minus[t] = minus[t] + first;
      q.plus[t] = plus[t] + first;
    }
    return q;
  }
};

template <int D>
Quantity quantity(const Row& row, In in, int c) {
  Quantity q;
  q.centre = row(in, c);
  for (int t = 0; t < D; ++t) {
    q.minus[t] = row(in, c, t, -1);
    q.plus[t] = row(in, c, t, 1);
  }
  return q;
}

// The sum of what belongs to all axes but d.
template <int D>
double others(const double* of_axis, int d) {
  if constexpr (D == 2) return of_axis[1 - d];
  return d == 0 ? of_axis[1] + of_axis[2] : of_axis[0] + of_axis[3 - d];
}

}  // namespace sluice::ice
