// Scenes drawn at random.
#pragma once
#include "properties/skew_deck.hpp"

namespace sluice::properties {

SkewCase draw_scene(unsigned long seed);
// A scene with two to four levels, not too large for a test.
SkewCase draw_scene_on_levels(unsigned long seed);

}  // namespace sluice::properties
