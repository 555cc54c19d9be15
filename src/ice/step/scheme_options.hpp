// What the scheme needs to know of a scene.
#pragma once
#include <vector>

#include "framework/scene/scene.hpp"
#include "ice/deck/ice_scene.hpp"
#include "ice/step/variables.hpp"

namespace sluice::ice {

// On the coarsest level; Ice::at_level() says what differs on others.
SchemeOptions scheme_options(const Scene& scene, const IceScene& ice);
// Whether faces along strong shocks exchange shear: step/shock_shear.hpp.
bool shears_shocks(const Scene& scene, const IceScene& ice);
// Of all materials, on the cells of a level.
std::vector<TransportModels> transport_models(const IceScene& ice, const Level& level);

}  // namespace sluice::ice
