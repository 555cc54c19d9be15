// Faces on sides of the domain through which the deck prescribes how fast the fluid moves, and the
// ghost cells just outside of them.
//
// There u_f is the velocity given, and the pressure is what the cell inside makes of it, as on a
// wall that moves (one_material/faces.cpp). What flows in is the state that is given: nothing
// pushes the ghost cell behind such a face, so that its Lagrangian values are those of its state.
// Where the fluid enters or leaves faster than sound nothing inside knows of the face: it is one
// like any other.
#pragma once
#include <algorithm>

#include "ice/step/side_faces.hpp"

namespace sluice::ice {

inline bool holds_velocities(const SchemeOptions& o) {
  return o.grid.boundary != nullptr && o.grid.boundary->holds_velocities();
}

// `u`: given, along the axis; the fluid enters with the sound speed of the ghost cell. m/s.
inline bool is_subsonic(double u, bool plus, double c_inside, double c_outside) {
  const double inward = plus ? -u : u;
  return inward < c_outside && -inward < c_inside;
}

// Calls f(i, plus, u) for every face of the row (low faces along `axis`) whose velocity u is given
// and subsonic; plus: the cell inside is on the low side.
template <class F>
void for_each_prescribed_face(const Row& row, const SchemeOptions& o, int axis, In velocity,
                              In sound, F&& f) {
  if (!holds_velocities(o)) return;
  const double middle = row.step().time + 0.5 * row.step().dt;
  const double *ua = row(velocity, axis, axis, -1), *ub = row(velocity, axis);
  const double *ca = row(sound, 0, axis, -1), *cb = row(sound);
  for_each_side_face(
      row, o, axis, [&](Side side) { return o.grid.boundary->holds_velocities(side); },
      [&](int i, IntVec3 cell, Side side, bool plus) {
        if (!o.grid.boundary->holds_velocity(side, cell)) return;
        const double u = o.grid.boundary->held_velocity(side, cell, plus ? ub[i] : ua[i], middle);
        if (is_subsonic(u, plus, plus ? ca[i] : cb[i], plus ? cb[i] : ca[i])) f(i, plus, u);
      });
}

// Calls f(i) for every cell of the row that lies just outside such a face.
template <class F>
void for_each_prescribed_ghost(const Row& row, const SchemeOptions& o, In velocity, In sound,
                               F&& f) {
  if (!holds_velocities(o)) return;
  for (int axis = 0; axis < o.grid.axes.count; ++axis) {
    const int d = o.grid.axes.direction[axis];
    const double *u = row(velocity, axis), *c = row(sound);
    for (const bool plus : {false, true}) {
      const Side side = side_of(d, plus);
      if (!o.grid.boundary->holds_velocities(side)) continue;
      const int outside = plus ? o.grid.domain.upper[d] : o.grid.domain.lower[d] - 1;
      IntVec3 cell = row.cell();
      const int first = axis == 0 ? std::max(outside - cell[d], 0) : 0;
      const int end = axis == 0 ? std::min(outside - cell[d] + 1, row.count()) : row.count();
      if (axis != 0 && cell[d] != outside) continue;
      cell[o.grid.axes.direction[0]] += first;
      for (int i = first; i < end; ++i) {
        if (o.grid.boundary->holds_velocity(side, cell) && is_subsonic(u[i], plus, c[i], c[i]))
          f(i);
        ++cell[o.grid.axes.direction[0]];
      }
    }
  }
}

// What the Lagrangian phase takes from the momentum of such cells: nothing.
inline void leave_prescribed_ghosts(const Row& row, const SchemeOptions& o, In velocity, In sound,
                                    Out impulse) {
  for_each_prescribed_ghost(row, o, velocity, sound, [&](int i) {
    for (int c = 0; c < o.grid.components; ++c) row(impulse, c)[i] = 0.0;
  });
}

}  // namespace sluice::ice
