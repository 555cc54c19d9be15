// From tiles to boxes: merged as large as ranks and threads allow, in whole tiles.
#pragma once
#include <vector>

#include "framework/refine/tile_layout.hpp"

namespace sluice {

// Owners by cells along the space-filling curve of assign_owners(). No box of several tiles has
// more than `max_cells` cells (0: no limit of that kind).
std::vector<GridBox> boxes_of_tiles(const TileLayout& layout, const FlagField& tiles, int ranks,
                                    int threads, std::int64_t max_cells = 0);

}  // namespace sluice
