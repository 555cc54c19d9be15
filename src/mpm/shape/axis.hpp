// One axis of a level as shape functions see it: places counted in cells from the middle.
//
// Counting from the middle of the domain makes every weight the exact mirror image of its twin on
// the other side: x -> -x gives s -> -s to the bit. Lengths in m.
#pragma once
#include <algorithm>
#include <cmath>

#include "framework/grid/level.hpp"

namespace sluice::mpm {

struct Axis {
  double middle = 0;   // of the domain, length
  double spacing = 1;  // h, length
  double inverse = 1;  // 1/h
  bool odd = false;    // the number of cells: then nodes lie half a cell beside whole numbers
  double first = 0;    // node (or cell) index of place 0 (odd: 1/2)
  // Corners that particles carry are multiples of this length, a power of two near the last bit of
  // a place at the far end of the domain: so sums of their places and ways are exact.
  double unit = 0x1p-52;

  // Place in cells from the middle; T: double, or Eight of eight places.
  template <class T>
  [[gnu::always_inline]] T place(const T& x) const {
    return (x - middle) * inverse;
  }
  // A length as a multiple of the unit.
  double rounded(double x) const { return std::nearbyint(x * (1 / unit)) * unit; }
};

inline Axis axis_of(const Level& level, int d) {
  const double h = level.spacing[d];
  const int low = level.domain.lower[d], cells = level.domain.size()[d];
  Axis a;
  a.middle = level.anchor[d] + (low + 0.5 * cells) * h;
  a.spacing = h;
  a.inverse = 1 / h;
  a.odd = cells % 2 != 0;
  // Node i lies at i - low - cells/2 cells from the middle.
  a.first = low + 0.5 * cells;
  const double start = level.anchor[d] + low * h, end = level.anchor[d] + (low + cells) * h;
  int exponent = 0;
  // A little more than the end: whatever its rounding on a level, all levels have one unit.
  std::frexp(std::max(std::fabs(start), std::fabs(end)) * (1 + 0x1p-20), &exponent);
  a.unit = std::ldexp(1.0, exponent - 52);
  return a;
}

}  // namespace sluice::mpm
