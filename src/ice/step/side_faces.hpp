// The faces of a row of faces that lie on sides of the domain.
#pragma once
#include "ice/boundary/boundary_fill.hpp"
#include "ice/step/variables.hpp"

namespace sluice::ice {

// Calls f(i, cell, side, plus) for every face of the row (low faces along `axis`, of these cells)
// on a side that takes(side); plus: the cell inside is on the low side.
template <class Takes, class F>
void for_each_side_face(const Row& row, const SchemeOptions& o, int axis, Takes&& takes, F&& f) {
  const int d = o.grid.axes.direction[axis];
  for (const bool plus : {false, true}) {
    const Side side = side_of(d, plus);
    if (!takes(side)) continue;
    const int face = plus ? o.grid.domain.upper[d] : o.grid.domain.lower[d];
    IntVec3 cell = row.cell();
    if (axis == 0) {
      const int i = face - cell[d];
      if (i >= 0 && i < row.count()) f(i, cell, side, plus);
      continue;
    }
    if (cell[d] != face) continue;
    for (int i = 0; i < row.count(); ++i) {
      f(i, cell, side, plus);
      ++cell[o.grid.axes.direction[0]];
    }
  }
}

}  // namespace sluice::ice
