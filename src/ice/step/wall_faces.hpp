// The faces of a row of faces that lie on a wall of the domain.
#pragma once
#include "ice/boundary/boundary_fill.hpp"
#include "ice/step/variables.hpp"

namespace sluice::ice {

// Calls f(i, plus) for every face of the row (low faces along `axis`) that is a wall; plus: the
// cell inside is on the low side.
template <class F>
void for_each_wall_face(const Row& row, const SchemeOptions& o, int axis, F&& f) {
  if (o.boundary == nullptr) return;
  const int d = o.axes.direction[axis];
  for (const bool plus : {false, true}) {
    const Side side = side_of(d, plus);
    if (!o.boundary->has_walls(side)) continue;
    const int face = plus ? o.domain.upper[d] : o.domain.lower[d];
    IntVec3 cell = row.cell();
    if (axis == 0) {
      const int i = face - cell[d];
      if (i >= 0 && i < row.count() && o.boundary->is_wall(side, cell)) f(i, plus);
      continue;
    }
    if (cell[d] != face) continue;
    for (int i = 0; i < row.count(); ++i) {
      if (o.boundary->is_wall(side, cell)) f(i, plus);
      ++cell[o.axes.direction[0]];
    }
  }
}

}  // namespace sluice::ice
