// Covered parts of the faces in periodic sides: where the rows begin that are summed from there.
//
// A body that crosses a periodic side is cut there: particles with their middle at one end of the
// domain, others at the other end, and the faces between them are no outer ones. So rows do not end
// outside of bodies. But each particle is closed: of all faces of a particle that crosses a side,
//
//   a_d(side) = sum of N_d beyond the high side  (at the high end)
//             = - sum of N_d beyond the low side (at the low end)
//
// and the sum over the particles, each by what is left of it, is the covered part of the side, as
// faces that particles share cancel but for that. In the side itself outer faces count as
// everywhere: they belong to the cell that the normal points to. Inner ones there belong to the
// cell above, or a body that two particles continue through the side would count twice; those of
// burned particles, whose two sides differ, by halves to both cells.
#pragma once
#include "mpmice/geometry/cell_sums.hpp"
#include "mpmice/geometry/outer_faces.hpp"

namespace sluice::mpmice {

template <int D>
class CoveredSides {
 public:
  void begin(const CellBlocks<D>& cells, const PeriodicSides<D>& sides);
  // Faces of the particles that crosses() names: outer ones, then inner ones.
  void add(const OuterFaces<D>& faces, bool outer, When when);
  // The time mean over the step, with mixed shapes (swept_volumes.hpp).
  void add_mean(const OuterFaces<D>& faces, bool outer);
  void sum_over_ranks(Communicator& ranks) { sums_.sum_over_ranks(ranks); }
  // Once all are added: sums of the cells beyond the high side along d, whose lower faces lie in
  // it.
  void finish();

  const PeriodicSides<D>& sides() const { return sides_; }
  // Adds a_d to the sums of these cells, from which add_from_above begins.
  void add_to(int d, std::uint64_t* lane) const;

 private:
  void add_piece(const Cell<D>& cell, const std::array<double, D>& area);

  PeriodicSides<D> sides_;
  CellSums<D> sums_;  // lanes N_d, in the cells beyond the high side along d
};

// Does a particle with corners from low to high, in cells, reach a periodic side.
template <int D>
bool crosses(const PeriodicSides<D>& sides, const std::array<double, D>& low,
             const std::array<double, D>& high) {
  for (std::size_t d = 0; d < D; ++d)
    if (sides.periodic[d] && (low[d] <= sides.domain.lower[d] || high[d] >= sides.domain.upper[d]))
      return true;
  return false;
}

}  // namespace sluice::mpmice
