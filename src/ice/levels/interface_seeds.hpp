// Where interfaces between materials lie: cells that a material fills in part, and both cells at a
// face where one that is full of it meets one that has none. Traces count as none: a run of many
// steps leaves some behind.
#pragma once
#include <vector>

#include "framework/run/component/component.hpp"
#include "framework/scene/refinement_settings.hpp"

namespace sluice::ice {

// Cells that interfaces between materials pass, one entry for each criterion that asks for a level
// finer than that of the state; ghost cells are filled. `materials`: under which numbers the state
// holds them.
std::vector<FlagSeeds> interface_seeds(const Warehouse& state, const std::vector<int>& materials,
                                       const std::vector<InterfaceCriterion>& criteria);

}  // namespace sluice::ice
