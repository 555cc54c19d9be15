// The state at the start: geometry objects, formulas, hydrostatic pressure.
#pragma once
#include <vector>

#include "framework/field/array_view.hpp"
#include "ice/deck/ice_scene.hpp"

namespace sluice::ice {

// Primitive values over a box of cells, x fastest: kg/m^3, K, Pa; m/s by direction.
struct PrimitiveFill {
  IndexBox cells;
  std::vector<double> density, temperature, pressure;
  std::vector<double> velocity[3];

  std::size_t offset(IntVec3 c) const {
    const IntVec3 n = cells.size(), r = c - cells.lower;
    return r.x + n.x * (r.y + static_cast<std::size_t>(n.y) * r.z);
  }
};

// The values of one material in every cell. Depends on the cell alone, not on the box asked for.
// Hydrostatic pressure is the reference pressure in the lowest cell of the coarsest level.
// Throws InputError naming the first cell that no object covers or that is not admissible.
PrimitiveFill fill_primitives(const IceScene& scene, const PhysicalConstants& constants,
                              const IceMaterial& material, const Level& coarsest,
                              const Level& level, const IndexBox& cells);

}  // namespace sluice::ice
