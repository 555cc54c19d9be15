// What a regridder must remember from one coarse step to the next, and across a restart.
#pragma once
#include <string>
#include <vector>

#include "framework/base/vec3.hpp"

namespace sluice {

// The tiles of one level, by tile index, sorted by (z, y, x).
struct TileSet {
  std::vector<IntVec3> tiles;
  friend bool operator==(const TileSet&, const TileSet&) = default;
};

struct RegridState {
  int last_step = 0;                   // of the last regrid
  std::vector<TileSet> tiles;          // by level; level 0 empty
  std::vector<std::vector<int>> idle;  // by level, by tile: coarse steps without a flag
  friend bool operator==(const RegridState&, const RegridState&) = default;
};

std::string to_json_text(const RegridState& state);
// Throws InputError when the text is not a regrid state.
RegridState regrid_state_from_json_text(const std::string& text);

}  // namespace sluice
