// The conserved state at the start, from what the deck fills cells with.
//
// Several materials: each has its own density and temperature where it is, at whatever pressure its
// law then has; one pressure is found before the first step, total energy kept. The momentum is the
// sum over the materials.
#pragma once
#include "framework/field/warehouse.hpp"
#include "framework/scene/scene.hpp"
#include "ice/deck/ice_scene.hpp"
#include "ice/step/variables.hpp"

namespace sluice::ice {

// Fills the cells of the local boxes. Throws DeckError where the materials of a cell have no common
// pressure.
void initialise(Warehouse& state, const Scene& scene, const IceScene& ice,
                const SchemeOptions& options);

}  // namespace sluice::ice
