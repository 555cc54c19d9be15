// Cells of the domain that no box of the coarsest level has: walls.
#pragma once
#include <algorithm>

#include "framework/grid/level.hpp"

namespace sluice {

inline bool has_gaps(const Level& coarsest) {
  return coarsest.cell_count() < coarsest.domain.volume();
}

// Is a node a corner of a cell that no box has, or of none that one has.
inline bool lies_on_gap(const Level& coarsest, IntVec3 node) {
  const IntVec3 low = node - coarsest.ghosts(1);
  IndexBox around;  // the cells that have this node as a corner, as far as they are in the domain
  for (int d = 0; d < 3; ++d) {
    around.lower[d] = std::max(low[d], coarsest.domain.lower[d]);
    around.upper[d] = std::min(node[d] + 1, coarsest.domain.upper[d]);
  }
  if (around.empty()) return false;  // beyond the sides of the domain
  std::int64_t filled = 0;
  for (const GridBox& box : coarsest.boxes) filled += intersection(box.cells, around).volume();
  return filled < around.volume();
}

}  // namespace sluice
