// Where interfaces between materials lie: cells that a material fills in part, and both cells at a
// face where one that is full of it meets one that has none. Traces count as none: a run of many
// steps leaves some behind.
#pragma once
#include <vector>

#include "framework/run/component.hpp"
#include "framework/scene/refinement_settings.hpp"
#include "ice/step/variables.hpp"

namespace sluice::ice {

// Cells that interfaces between materials pass, one entry for each criterion that asks for a level
// finer than that of the state; ghost cells are filled.
std::vector<FlagSeeds> interface_seeds(const Warehouse& state, const SchemeOptions& options,
                                       const std::vector<InterfaceCriterion>& criteria);

}  // namespace sluice::ice
