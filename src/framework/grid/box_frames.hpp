// Boxes that follow each other share one array, a *frame*: what one of them holds as ghosts are
// the cells and the ghosts of the others, and need no copy.
#pragma once
#include <cstdint>
#include <vector>

#include "framework/grid/level.hpp"

namespace sluice {

// Has every box arrays of its own, or do boxes share frames: for fields whose ghosts hold what the
// cells do that they stand for.
enum class Arrays { own, shared };

struct BoxFrame {
  IndexBox hull;           // of the boxes and their ghosts
  std::vector<int> boxes;  // positions in the list, ascending along the last active direction
};

// Puts every box into one frame. Boxes share one where they meet along the last active direction
// (of two or three), a frame takes no more memory than an array for each of its boxes would, and
// ghosts are the same for all: boxes that have ghosts beyond a side of the domain across are alone
// (what a side gives depends on neighbours along it, which the outermost ghosts of a box lack).
// Boxes lower than their ghosts are alone, too: ghosts reach the next box and none beyond.
std::vector<BoxFrame> box_frames(const std::vector<GridBox>& boxes, const Level& level, int ghosts);

// By box of a level, what of its ghosts the others of its frame provide: cells of those after it,
// cells and ghosts of those before it.
std::vector<std::vector<IndexBox>> held_by_frames(const Level& level, int ghosts, Arrays arrays);

// Numbers of one component that the frames of the boxes of `rank` hold.
std::int64_t framed_cells(const Level& level, int rank, int ghosts);

}  // namespace sluice
