// Which cells of a level ask for a finer one: what the component's criteria say, and regions.
#pragma once
#include "framework/refine/regridder.hpp"
#include "framework/run/component.hpp"
#include "framework/run/level_solver.hpp"
#include "framework/scene/refinement_settings.hpp"

namespace sluice {

// Ghost cells must be filled. Collective: all ranks get the flags of all boxes.
FlagField flags_of_level(LevelSolver& solver, const Component& component,
                         const RefinementSettings& settings, double time,
                         Communicator& communicator);

}  // namespace sluice
