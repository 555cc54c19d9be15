// Pieces of the surface of a solid as the step ends, each with the fluid in front of it and the
// solid behind it.
//
// In front: the cell that the piece lies in (one in a grid plane lies in the cell that it looks
// into), or, where solids take more than half of that cell, the next one along the largest
// component of the normal: the two share what they hold (redistribute.cpp). Fluid stands at the
// centre of its cell, as conduction and friction between cells have it.
// Behind: the nodes around the middle of the particle whose face it is, with hat functions. They
// hold what particles around them hold, and there is solid at each of them wherever the surface
// lies in its cell.
#pragma once
#include "mpmice/fields/cell_amounts.hpp"
#include "mpmice/surfaces/surface_pieces.hpp"

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

// Of all particles of one kind that has its outer faces at both ends of the step; one for each face
// and cell in front of it.
template <int D>
KeptArray<SurfaceContact<D>> surface_contacts(const NearCells<D>& near,
                                              const SolidGeometry<D>& solid,
                                              const CellAmounts<D>& fluid,
                                              const std::vector<SolidSet<D>>& sets, int kind);

// A node of the grid, the low corner of a cell, and its share of a particle.
template <int D>
struct NodeShare {
  std::size_t node;  // place of that cell in the arrays
  double weight;
};

// The nodes of the cell in which the middle of particle p stands, weights of hat functions there.
template <int D>
std::array<NodeShare<D>, 1 << D> nodes_around(const Frame<D>& frame, const ParticleSet& set,
                                              std::size_t p) {
  Cell<D> low;
  std::array<double, D> share;
  for (std::size_t d = 0; d < D; ++d) {
    const int of = frame.direction[d];
    const double x = (set.coordinate(of)[p] - frame.anchor[of]) / frame.spacing[of];
    low[d] = static_cast<int>(std::floor(x));
    share[d] = x - std::floor(x);
  }
  // Most lie in one block with the others.
  bool inside = true;
  for (std::size_t d = 0; d < D; ++d)
    inside &= low[d] >= frame.domain.lower[d] && low[d] + 1 < frame.domain.upper[d] &&
              ((low[d] + 1) & (CellBlocks<D>::edge - 1)) != 0;
  const std::size_t first = inside ? frame.cells.index_to_add(low) : 0;
  std::array<NodeShare<D>, 1 << D> nodes;
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    Cell<D> node = low;
    nodes[n].weight = 1;
    std::size_t further = 0;
    for (std::size_t d = 0; d < D; ++d) {
      const int up = static_cast<int>(n >> d & 1);
      node[d] += up;
      nodes[n].weight *= up != 0 ? share[d] : 1 - share[d];
      further += up != 0 ? CellBlocks<D>::stride(static_cast<int>(d)) : 0;
    }
    nodes[n].node = inside ? first + further : frame.cells.index_to_add(frame.wrapped(node));
  }
  return nodes;
}

}  // namespace sluice::mpmice
