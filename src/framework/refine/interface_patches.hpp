// Where a level meets a finer one: patches of faces between one coarse and one fine box.
#pragma once
#include <vector>

#include "framework/grid/level.hpp"

namespace sluice {

// Faces of the coarse level with a cell outside the finer level on one side, and fine cells on the
// other. `coarse_cells` lie in the domain: across a periodic end they are those of its other end.
struct InterfacePatch {
  int fine_box = 0, coarse_box = 0;  // ids
  int axis = 0;                      // among the active directions
  bool high = false;                 // the high faces of the coarse cells, the low ones of the fine
  IndexBox coarse_cells;             // one layer along the axis
  IndexBox fine_cells;               // at the same faces: one layer of the fine box
};

// All patches with a box of `rank` on either side. Any two ranks find those they share in the same
// order. Fine boxes must begin and end at coarse cells, and the coarse level must hold one layer of
// cells around them.
std::vector<InterfacePatch> interface_patches(const Level& coarse, const Level& fine, int rank);

}  // namespace sluice
