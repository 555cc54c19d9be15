// Geometry that lies between the points at which cells look for it, or outside of the domain.
#pragma once
#include <vector>

#include "framework/deck/deck.hpp"
#include "framework/grid/level.hpp"
#include "framework/scene/geometry_reader.hpp"

namespace sluice {

// Warns of every piece in the <geom_object>s of a block that covers no cell of any level.
void warn_of_empty_pieces(const DeckNode& block, const GeometryReader& geometry, const Grid& grid,
                          std::vector<Fault>& faults);

}  // namespace sluice
