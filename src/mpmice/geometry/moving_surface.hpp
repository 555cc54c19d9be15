// The sums of surfaces that move, in one pass: theta and covered parts at the end of the step
// (solid_in_cells.hpp), and what is swept (swept_volumes.hpp).
#pragma once
#include "mpmice/geometry/facet_groups.hpp"
#include "mpmice/geometry/solid_in_cells.hpp"
#include "mpmice/geometry/swept_volumes.hpp"

namespace sluice::mpmice {

template <int D>
class MovingSurface {
 public:
  // Adds all faces to sums that were begun over the same blocks, and marks the cells that they span
  // in the step. Throws std::out_of_range where a facet reaches a cell without block, or over more
  // than most_move cells.
  void add(const OuterFaces<D>& faces, SolidSums<D>& end, SweptSums<D>& swept, FreeCells<D>& free);

 private:
  // Of three dimensions; they keep their memory.
  FacetGroups groups_;
  KeptArray<std::uint64_t> numbers_;  // numbers_of_cell of each cell
  KeptArray<std::uint32_t> left_;
};

}  // namespace sluice::mpmice
