// Levels as VTK gets them.
#pragma once
#include <vector>

#include "framework/grid/level.hpp"

namespace sluice {

// VTK's AMR data sets have one refinement ratio for all directions, so that in a direction of one
// cell, which we do not refine, every cell becomes `copies` thin ones.
struct VtkLevel {
  Level level;
  IntVec3 copies{1, 1, 1};

  IndexBox spread(const IndexBox& box) const;
  // The cell of which this one is a copy.
  IntVec3 source(IntVec3 c) const;
};

// False where the directions that are refined have different ratios.
bool fits_vtk_amr(const Grid& grid);
// For AMR data sets; other files have the levels as they are.
std::vector<VtkLevel> vtk_amr_levels(const Grid& grid);

}  // namespace sluice
