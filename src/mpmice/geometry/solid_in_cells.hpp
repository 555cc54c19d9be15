// Solids in cells at one time: volume fractions, covered parts of faces, areas of surfaces.
//
// From the pieces of outer faces alone; particles are never clipped. With area vectors n, fractions
// s and moments m of the pieces in a cell whose lower corner is X,
//
//   N_d = sum n_d s,   T_d = sum n_d (sum_k m_k (P_k - X)_d),
//   a_d(lower face) = a_d(upper face) + N_d,   theta = a_d(upper face) + T_d  for every d
//
// (divergence theorem, for fields 1 and x_d in the part of the cell that is solid). Bodies are
// closed, and blocks of cells hold all of them: a = 0 where no block is above, and rows are summed
// from there. A body that ends on a side of the domain has faces there too, whose pieces belong to
// the cell that the normal points to: a layer beyond the domain must have blocks. theta is taken
// with d = x.
// Across periodic sides sums join those of the image cells, and rows begin with what covers the
// side (covered_sides.hpp).
#pragma once
#include <span>

#include "mpmice/geometry/cell_sums.hpp"
#include "mpmice/geometry/covered_sides.hpp"
#include "mpmice/geometry/pieces.hpp"

namespace sluice::mpmice {

// Arrays over the cells of blocks, zero where no surface is near. As summed: clean_... below.
template <int D>
struct SolidInCells {
  KeptArray<double> theta;             // volume fraction of solid
  std::array<KeptArray<double>, D> a;  // lower faces along d: the part inside or touched by solid
  std::array<KeptArray<double>, D> n;  // N_d = a(lower) - a(upper): area vector of the surface
};

template <int D>
class SolidSums {
 public:
  // Keeps a reference to the blocks.
  void begin(const CellBlocks<D>& cells) { sums_.begin(cells, D + 1); }
  // Faces begin to end - 1. Throws std::out_of_range where a piece lies in no block.
  void add(const OuterFaces<D>& faces, When when, std::size_t begin, std::size_t end);
  // All faces, of which these are the pieces.
  void add(const OuterFaces<D>& faces, const CutSurface<D>& pieces);
  // Facet t of face i.
  void add_facet(const OuterFaces<D>& faces, When when, std::size_t i, int t);
  CellSums<D>& sums() { return sums_; }  // lanes N_d, T_x
  void merge(const SolidSums& other) { sums_.merge(other.sums_); }
  void sum_over_ranks(Communicator& ranks) { sums_.sum_over_ranks(ranks); }
  // Uses up the sums: begin() is next. `sides`: where bodies may cross periodic ones.
  void finish(SolidInCells<D>& to, const CoveredSides<D>* sides = nullptr);

 private:
  void add_piece(const Piece<D>& piece, const FacetNodes<D>& nodes, double weight);

  CellSums<D> sums_;  // lanes N_d, T_x
};

// Parts of faces as the fluid wants them: |a| < 1e-14 -> 0, a within 1e-14 of 1 or above -> 1,
// none below 0 (bodies that overlap count twice in sums).
void clean_covered_parts(std::span<double> a);
// Volume fractions likewise: theta < 1e-14 -> 0; 1 - theta < 1e-10 -> 1, above the round-off of
// overlaps.
void clean_volume_fractions(std::span<double> theta);

}  // namespace sluice::mpmice
