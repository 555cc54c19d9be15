// The state at the start of several materials that share cells.
#pragma once
#include <vector>

#include "ice/start/initial_state.hpp"
#include "ice/start/weight_profile.hpp"

namespace sluice::ice {

// Values of one material; only those of cells where its volume fraction is above zero mean
// anything.
struct MaterialFill : PrimitiveFill {
  std::vector<double> volume_fraction;  // to the bit: 0 where absent, 1 where alone
};

struct MixtureFill {
  IndexBox cells;
  std::vector<MaterialFill> materials;

  std::size_t offset(IntVec3 c) const { return materials.front().offset(c); }
};

// Density, temperature, pressure and velocity of each material itself, and its share of each cell.
// A share is the number of sub-points of the cell inside the material's objects, those counted once
// that several objects hold; values come from the last object that holds a sub-point. Under gravity
// the pressure balances the weight of what surrounds (weight_profile.hpp). Depends on the cell
// alone, not on the box asked for.
// Throws InputError naming the first cell where the fractions do not sum to one, or where a
// material's law has no such state.
MixtureFill fill_materials(const IceScene& scene, const PhysicalConstants& constants,
                           const Level& coarsest, const Level& level, const IndexBox& cells,
                           const WeightProfile& weight);
// The same before gravity acts.
MixtureFill fill_weightless(const IceScene& scene, const PhysicalConstants& constants,
                            const Level& coarsest, const Level& level, const IndexBox& cells);

}  // namespace sluice::ice
