// Overrides that scale what a deck says: its step, its resolution, how stiff its solids are or how
// strong its materials exchange momentum.
#pragma once
#include <string>
#include <vector>

#include "framework/base/vec3.hpp"
#include "framework/deck/deck.hpp"

namespace sluice {

// All take the root of a deck that was loaded without errors, and give PATH=VALUE.

// The step that the physics allows, times `factor`.
std::vector<std::string> step_overrides(const DeckNode& root, double factor);

// Cells of the bounding box of the coarsest level; 0 where the deck has no grid.
IntVec3 cells_of_deck(const DeckNode& root);

// Cells along each direction, times `factor` (rounded; a flat direction stays one), of all
// levels that the deck writes.
std::vector<std::string> resolution_overrides(const DeckNode& root, double factor);

// What stiffness is in this deck: "moduli of the solids", "exchange of momentum", or empty where it
// has neither.
std::string stiffness_name(const DeckNode& root);
std::vector<std::string> stiffness_overrides(const DeckNode& root, double factor);

}  // namespace sluice
