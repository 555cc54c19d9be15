// The faces of a row of faces that lie on a wall of the domain.
#pragma once
#include "ice/step/side_faces.hpp"

namespace sluice::ice {

// Calls f(i, plus) for every face of the row (low faces along `axis`) that is a wall; plus: the
// cell inside is on the low side.
template <class F>
void for_each_wall_face(const Row& row, const SchemeOptions& o, int axis, F&& f) {
  if (o.grid.boundary == nullptr) return;
  for_each_side_face(
      row, o, axis, [&](Side side) { return o.grid.boundary->has_walls(side); },
      [&](int i, IntVec3 cell, Side side, bool plus) {
        if (o.grid.boundary->is_wall(side, cell)) f(i, plus);
      });
}

}  // namespace sluice::ice
