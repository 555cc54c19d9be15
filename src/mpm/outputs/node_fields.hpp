// Fields that solids have on nodes when they are saved: g.mass, g.velocity, g.stressFS, ...
//
// All are of the state between two steps, by material, before contact and boundary values: what the
// next step would begin with.
#pragma once
#include <vector>

#include "framework/run/component/grid_fields.hpp"
#include "mpm/step/solid_step.hpp"

namespace sluice::mpm {

std::vector<Label> node_labels();

// Into the labels that `fields` has. `step` is one that is not under way. Collective.
void store_node_fields(const Scene& scene, const MpmScene& solids, SolidStep& step,
                       const StageScope& scope, GridFields& fields);

}  // namespace sluice::mpm
