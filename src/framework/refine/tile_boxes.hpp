// From tiles to boxes: merged as large as ranks and threads allow, in whole tiles.
#pragma once
#include <vector>

#include "framework/refine/tile_layout.hpp"

namespace sluice {

// Owners by cells along the space-filling curve of assign_owners().
std::vector<GridBox> boxes_of_tiles(const TileLayout& layout, const FlagField& tiles, int ranks,
                                    int threads);

}  // namespace sluice
