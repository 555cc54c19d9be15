// Pieces of the surface of a solid as the step ends, each with the fluid in front of it and the
// solid behind it.
//
// In front: the cell that the piece lies in (one in a grid plane lies in the cell that it looks
// into), or, where solids take more than half of that cell, the next one along the largest
// component of the normal: the two share what they hold (redistribute.cpp). Fluid stands at the
// centre of its cell, as conduction and friction between cells have it.
// Behind: the cells of the parts of the particle whose face it is. That is a layer of about one
// cell, wherever the surface lies in its own, and there is solid in each of them.
#pragma once
#include "mpmice/step/solid_sets.hpp"

namespace sluice::mpmice {

template <int D>
struct SurfaceContact {
  std::uint32_t set = 0, particle = 0;
  std::size_t fluid = 0;           // place of the cell in front, in the arrays
  double area = 0;                 // A, over the volume of a cell, 1/m
  double width = 0;                // V/A of a cell that a plane along the piece halves, m
  double to_fluid = 0;             // d_g: from the piece to the centre of that cell, m
  std::array<double, D> normal{};  // unit, out of the solid
  std::array<double, D> place{};   // of the middle of the piece, cells
};

// Of all particles of one kind that has its outer faces at both ends of the step.
template <int D>
std::vector<SurfaceContact<D>> surface_contacts(const Frame<D>& frame, const SolidFields<D>& solids,
                                                const CellAmounts<D>& fluid,
                                                const std::vector<SolidSet<D>>& sets, int kind);

// `cell`, which stands for itself or is the image `own` of the domain, as one counts from `cell`:
// on across periodic sides, at the side where the domain ends.
template <int D>
Cell<D> seen_cell(const Frame<D>& frame, const Cell<D>& cell, Cell<D> own) {
  for (std::size_t d = 0; d < D; ++d)
    if (frame.periodic[d]) own[d] = cell[d];
  return own;
}

// Where the middle of particle p stands along the d-th direction, cells.
template <int D>
double middle_in_cells(const Frame<D>& frame, const ParticleSet& set, std::size_t p,
                       std::size_t d) {
  const int of = frame.direction[d];
  return (set.coordinate(of)[p] - frame.anchor[of]) / frame.spacing[of];
}

// The cell in which it stands.
template <int D>
Cell<D> cell_of_middle(const Frame<D>& frame, const ParticleSet& set, std::size_t p) {
  Cell<D> c;
  for (std::size_t d = 0; d < D; ++d)
    c[d] = frame.cell_at(set.coordinate(frame.direction[d])[p], d);
  return frame.inside(c);
}

}  // namespace sluice::mpmice
