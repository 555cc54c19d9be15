// What rules of contact ask of the particles around a node, as exact integer sums: lanes
//
//   sum V S | sum V grad S (3) | sum V (x_p - x_i) S (3) | count
//
// S: GIMP weights of the particles' own widths, whatever the basis of the transfers: with wider
// ones bodies would stick to nodes above their surface (docs/theory/mpm_contact.md). The
// vectors stand where nodes have momentum and force, so that images across sides are folded alike.
#pragma once
#include "mpm/transfer/to_grid.hpp"

namespace sluice::mpm {

// Units of the integers (2^k), of the sums in m^3, m^2 and m^4. Larger volumes (m^3) than
// `max_volume`, 2 cells wide, count as that.
struct SurfaceUnits {
  double volume = 1, gradient = 1, place = 1;
  double max_volume = 1;
};
SurfaceUnits surface_units(const Level& level, bool axisymmetric);

// Particles begin to end of one block into a window of reach 1. grid.half: their half widths.
void add_surfaces(const TransferGrid& grid, const std::array<const double*, 3>& x,
                  const double* volume, int begin, int end, const SurfaceUnits& units,
                  Window& window);

// The sums of a node: volume, gradient, and the place divided by the volume; all 0 where no
// particle reaches it. m^3, m^2, m.
struct SurfaceAtNode {
  double volume = 0;
  Vec3 gradient{}, place{};
};
SurfaceAtNode surface_at(const std::int64_t* node, const SurfaceUnits& units);

}  // namespace sluice::mpm
