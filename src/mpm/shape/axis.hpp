// One axis of a level as shape functions see it: places counted in cells from the middle.
//
// Counting from the middle of the domain makes every weight the exact mirror image of its twin on
// the other side: x -> -x gives s -> -s to the bit.
#pragma once
#include "framework/grid/level.hpp"

namespace sluice::mpm {

struct Axis {
  double middle = 0;   // of the domain, length
  double spacing = 1;  // h, length
  double inverse = 1;  // 1/h
  bool odd = false;    // the number of cells: then nodes lie half a cell beside whole numbers
  double first = 0;    // node (or cell) index of place 0 (odd: 1/2)

  // Place in cells from the middle.
  double place(double x) const { return (x - middle) * inverse; }
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
  return a;
}

}  // namespace sluice::mpm
