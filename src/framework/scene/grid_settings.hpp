// The deck's <Grid>: levels, their boxes, spacing and periodicity, and the Grid built from them.
//
// The low corner of all level-0 boxes is the anchor of every level: node i of a level lies at
// anchor + i dx. Box corners must lie on nodes of their level; boxes of a level share one spacing
// and do not overlap; a finer level lies inside the next coarser one, its spacing an integral
// fraction of the coarser one's. Lengths in m.
#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "framework/deck/deck.hpp"
#include "framework/grid/level.hpp"

namespace sluice {

struct BoxSettings {
  std::string label;
  Vec3 lower{}, upper{};  // length
  IndexBox cells;         // in indices of its level, filled in when the box is found good
  IntVec3 patches{1, 1, 1};
  int auto_patch = 0;             // patches a rank; 0: `patches` counts
  std::array<bool, 3> flatten{};  // directions that autoPatch must not cut
  IntVec3 extra_cells{};          // read and kept; ghost layers follow from the scheme
  Location where;
};

struct LevelSettings {
  std::vector<BoxSettings> boxes;  // none: a regridder fills the level
  Vec3 spacing{1, 1, 1};
  IntVec3 ratio{1, 1, 1};
  std::array<bool, 3> periodic{};
  Location where;
};

struct GridSettings {
  Vec3 anchor{};
  std::vector<LevelSettings> levels;  // coarse to fine
  Location where;
};

// Everything that is wrong is added to `faults`; build a Grid only when there is no error.
GridSettings read_grid_settings(const DeckNode& grid, std::vector<Fault>& faults);

struct GridOptions {
  int ranks = 1;
  IntVec3 boxes{};  // forced split of every deck box; 0: as the deck says
  std::array<bool, 3> active{true, true, true};
};

// Cuts levels into boxes and deals them out to ranks. With fewer deck patches than ranks the level
// is cut further (results do not depend on it); InputError when there are fewer cells than ranks.
// Each deck box of a finer level is cut into as many boxes as ranks need, between coarse cells.
Grid build_grid(const GridSettings& settings, const GridOptions& options);

}  // namespace sluice
