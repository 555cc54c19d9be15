// Bounds of what one particle gives to a node, and the units of sums that follow from them
// (mpm_scheme, section 4).
#pragma once
#include "mpm/boundary/node_boundary.hpp"
#include "mpm/step/body.hpp"

namespace sluice::mpm {

// Of the finest and the coarsest level: bounds of sums are the same on all.
struct LevelSpacings {
  Vec3 finest{}, coarsest{};
  bool several() const { return finest != coarsest; }
};

// Of a body whose particles have these rates; `tension`: of what acts beside the stress, J.
SumUnits sum_units(const MpmScene& solids, const NodeBoundary& boundary,
                   const LevelSpacings& spacings, const Body& body, int kind,
                   const KindRates& rates, double tension);

// Of the books of energy, on a level. `heats`: heat can move.
EnergyUnits energy_units(const MpmScene& solids, const Level& level, const Body& body, bool heats);

}  // namespace sluice::mpm
