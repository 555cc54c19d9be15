// Reading the blocks of solids of a deck that the schema has checked.
#pragma once
#include <vector>

#include "framework/deck/deck.hpp"
#include "framework/scene/scene.hpp"
#include "mpm/deck/mpm_scene.hpp"

namespace sluice::mpm {

// Everything that is wrong is added to `faults`; with an error among them the scene is of no use.
MpmScene read_mpm_scene(const Deck& deck, const Scene& scene, std::vector<Fault>& faults);

}  // namespace sluice::mpm
