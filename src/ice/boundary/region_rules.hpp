// The rules of ghosts (conditions/ghost_rule.hpp) that a boundary region gives: for one material,
// and for all of them together.
#pragma once
#include <span>
#include <vector>

#include "framework/scene/boundary.hpp"
#include "ice/conditions/flow_conditions.hpp"
#include "ice/conditions/ghost_rule.hpp"
#include "ice/deck/ice_scene.hpp"

namespace sluice::ice {

// threshold: part of a cell that the volumes of a side may leave empty: decks write as many
//   digits; unit: 1; test: MixtureGhosts.VolumesThatDoNotFillACellAreRefused
constexpr double unfilled = 1e-6;

// Throws InputError with the deck's line of a condition that is not supported, or whose block is
// missing. `normal`: the direction of the side.
GhostRule make_rule(const BoundaryRegion& region, int material, int normal,
                    const FlowConditions& conditions);

// Of a gas that fills its cells alone; also refuses a SpecificVol that is not 1/Density.
GhostRule make_gas_rule(const BoundaryRegion& region, int material, int normal,
                        const FlowConditions& conditions);

// Of several materials with one velocity and one pressure. Densities given are masses per volume
// of the cell. Where all are given, what each fills follows from the specific volumes given, or
// from temperatures and pressure; a pressure that is not given is the one at which they fill the
// cell. Less than 1e-9 of the largest density means absent.
struct MixtureRule {
  struct Part {
    GhostRule rule;
    bool absent = false;
    double volume = -1;  // share of the cell, where known beforehand
  };
  std::vector<Part> parts;  // by material
  // Plain where all are so alike; mirrored where those present are. Also the pressure.
  GhostRule common;
  bool plain = false;
};

// Throws InputError for conditions that contradict each other: a wall for some materials only,
// volumes that do not fill the cell, or too little to know them.
MixtureRule make_mixture_rule(const BoundaryRegion& region, std::span<const IceMaterial> materials,
                              int normal, const FlowConditions& conditions);

}  // namespace sluice::ice
