// Which cells of a level ask for a finer one: what the component's criteria say, and regions.
#pragma once
#include <vector>

#include "framework/refine/flag_field.hpp"
#include "framework/run/component.hpp"
#include "framework/run/level_solver.hpp"
#include "framework/run/region_flags.hpp"
#include "framework/scene/refinement_settings.hpp"

namespace sluice {

class RefinementFlags {
 public:
  // `levels`: every level that may exist.
  RefinementFlags(const RefinementSettings& settings, const Component& component,
                  const std::vector<Level>& levels);
  // Ghost cells must be filled. Collective: all ranks get the flags of all boxes.
  FlagField of_level(LevelSolver& solver, double time, Communicator& communicator);

 private:
  Label flag_;
  std::vector<RegionFlags> regions_;  // by level
};

}  // namespace sluice
