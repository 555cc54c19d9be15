// The faces of a row of faces on the sides of the domain, and what each makes of the solve.
#pragma once
#include "ice/boundary/boundary_fill.hpp"
#include "ice/pressure/error_rows.hpp"
#include "ice/pressure/open_faces.hpp"
#include "ice/step/variables.hpp"

namespace sluice::ice::pressure {

// Calls f(i, plus, kind) for every such face (low faces along `axis`); plus: the cell inside is on
// the low side. None in periodic directions.
template <class F>
void for_each_side_face(const Row& row, const SchemeOptions& o, int axis, F&& f) {
  if (o.grid.boundary == nullptr) return;
  const int d = o.grid.axes.direction[axis];
  if (o.grid.periodic[d]) return;
  for (const bool plus : {false, true}) {
    const Side side = side_of(d, plus);
    const int face = plus ? o.grid.domain.upper[d] : o.grid.domain.lower[d];
    IntVec3 cell = row.cell();
    if (axis == 0) {
      const int i = face - cell[d];
      if (i >= 0 && i < row.count()) f(i, plus, o.grid.boundary->side_kind(side, cell));
      continue;
    }
    if (cell[d] != face) continue;
    for (int i = 0; i < row.count(); ++i) {
      f(i, plus, o.grid.boundary->side_kind(side, cell));
      ++cell[o.grid.axes.direction[0]];
    }
  }
}

}  // namespace sluice::ice::pressure
