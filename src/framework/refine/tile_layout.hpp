// The tiles of a level: how they divide its domain, which of them flags ask for.
//
// Tile t of n lies over coarse cells [N t / n, N (t + 1) / n), the upper half mirrored from the
// lower one, so that mirrored problems have mirrored tiles. n is the number of whole tiles that the
// level holds, one fewer where an even number could not lie symmetrically over an odd number of
// coarse cells; so no tile is smaller than the deck asks. Edges are those of coarse cells.
#pragma once
#include <array>
#include <vector>

#include "framework/grid/level.hpp"
#include "framework/refine/flag_field.hpp"

namespace sluice {

class TileLayout {
 public:
  TileLayout() = default;
  TileLayout(const Level& level, IntVec3 tile);

  IntVec3 count() const { return count_; }
  IndexBox all() const { return {{0, 0, 0}, count_}; }
  // Cells of the level in a box of tiles.
  IndexBox cells(const IndexBox& tiles) const;
  IndexBox cells(IntVec3 tile) const { return cells({tile, tile + IntVec3::all(1)}); }
  // The tiles, as flags over all(), that hold a flag of the next coarser level.
  FlagField holding(const FlagField& coarse_flags) const;

 private:
  void hold_row(const std::vector<std::uint64_t>& cells, std::uint64_t* tiles,
                std::size_t tile_words) const;

  IntVec3 count_{1, 1, 1}, ratio_{1, 1, 1}, lower_{};
  std::array<std::vector<int>, 3> edges_;  // in coarse cells from the domain's low corner
  std::vector<int> tile_along_x_;          // by coarse cell
  int width_along_x_ = 0;                  // in coarse cells, when all are the same power of two
};

// Boxes of tiles that together are the flagged ones: runs along x, equal runs of neighbouring rows
// joined to rectangles, equal rectangles of neighbouring planes to blocks.
std::vector<IndexBox> merged_tiles(const FlagField& tiles);

}  // namespace sluice
