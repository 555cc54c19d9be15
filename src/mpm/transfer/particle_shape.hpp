// What shape functions ask of particles beside their places: widths, edges, stretch.
#pragma once
#include <array>

#include "mpm/deck/mpm_scene.hpp"
#include "mpm/material/base/material.hpp"
#include "mpm/shape/axis.hpp"

namespace sluice::mpm {

// What a level's transfers need to know.
struct TransferGrid {
  std::array<Axis, 3> axes;
  std::array<int, 3> active{};  // directions, rising; `count` of them
  int count = 3;
  std::array<double, 3> half{0.5, 0.5, 0.5};  // half width of particles in cells (GIMP)
  double corner_limit = 1e300;  // half diagonals of particles are cut to this length, cells (CPDI)
};

inline constexpr int max_corners = 8;

// Columns of the particles of a set; those that a basis does not need may be null.
struct ParticleShape {
  std::array<const double*, 3> half{};  // half widths in cells; null: TransferGrid::half for all
  Nine<const double> F{};               // deformation gradient at the start of the step, no unit
  Nine<const double> edges{};           // R0: edges in the reference state, in cells (columns)
  // Of a basis whose particles carry their corners: component d of corner c in column 3 c + d, m.
  std::array<const double*, 3 * max_corners> corners{};
};

inline bool by_corners(Basis basis) {
  return basis == Basis::cpdi || basis == Basis::fast_cpdi || basis == Basis::cpti ||
         basis == Basis::carried;
}

// Have the particles half widths of their own: those of the set, or such as follow the stretch.
inline bool has_own_widths(Basis basis, const ParticleShape& shape) {
  return basis == Basis::cpgimp || (basis == Basis::gimp && shape.half[0] != nullptr);
}

// Half widths in cells of particles at, ..., at + n - 1 along an axis, into `to`. cpgimp: l F_dd
// (contiguous particles: S. G. Bardenhagen, E. M. Kober, CMES 5 (2004) 477). Three nodes hold
// particles of at most one cell: wider ones are taken as so wide.
void own_widths(Basis basis, const TransferGrid& grid, const ParticleShape& shape, int d, int at,
                int n, double* to);

}  // namespace sluice::mpm
