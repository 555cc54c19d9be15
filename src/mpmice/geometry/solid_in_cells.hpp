// Solids in cells at one time: volume fractions, covered parts of faces, areas of surfaces.
//
// From the pieces of outer faces alone; particles are never clipped. With area vectors n, fractions
// s and moments m of the pieces in a cell whose lower corner is X,
//
//   N_d = sum n_d s,   T_d = sum n_d (sum_k m_k (P_k - X)_d),
//   theta = a_d(upper face) + T_d,   a_d(lower face) = theta - T_d + N_d   for every d
//
// (divergence theorem, for fields 1 and x_d in the part of the cell that is solid), so that a and
// theta of all cells of a block follow from theta of one (free_cells.hpp). A body that ends on a
// side of the domain has faces there too, whose pieces belong to the cell that the normal points
// to: a layer beyond the domain must have blocks. Across periodic sides sums join those of the
// image cells.
#pragma once
#include <span>

#include "mpmice/geometry/free_cells.hpp"
#include "mpmice/geometry/pieces.hpp"

namespace sluice::mpmice {

// Arrays over the cells of blocks. As summed: clean_... below.
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
  void begin(const CellBlocks<D>& cells) { sums_.begin(cells, 2 * D); }
  // Faces begin to end - 1, which mark the cells of their pieces where these are not marked by
  // others (`free` null). Throws std::out_of_range where a piece lies in no block.
  void add(const OuterFaces<D>& faces, When when, std::size_t begin, std::size_t end,
           FreeCells<D>* free);
  // All faces, of which these are the pieces.
  void add(const OuterFaces<D>& faces, const CutSurface<D>& pieces, FreeCells<D>& free);
  // Facet t of face i.
  void add_facet(const OuterFaces<D>& faces, When when, std::size_t i, int t, FreeCells<D>* free);
  CellSums<D>& sums() { return sums_; }  // lanes N_d, T_d
  void merge(const SolidSums& other) { sums_.merge(other.sums_); }
  void sum_over_ranks(Communicator& ranks) { sums_.sum_over_ranks(ranks); }
  // Uses up the sums: begin() is next. `references`: theta of the lowest cells of blocks that begin
  // there.
  void finish(const FreeCells<D>& free, const std::uint64_t* references, SolidInCells<D>& to);

 private:
  void add_piece(const Piece<D>& piece, double weight, FreeCells<D>* free);

  CellSums<D> sums_;
  KeptArray<std::uint64_t> theta_;
};

// theta and a_d from sums of which lanes 0 to D - 1 are N_d, the next D are T_d.
template <int D>
void find_covered_parts(const FreeCells<D>& free, const CellSums<D>& sums,
                        const std::uint64_t* references, KeptArray<std::uint64_t>& theta,
                        std::array<KeptArray<double>, D>& a);

// Parts of faces as the fluid wants them: |a| < 1e-14 -> 0, a within 1e-14 of 1 or above -> 1,
// none below 0 (bodies that overlap count twice in sums).
void clean_covered_parts(std::span<double> a);
// Volume fractions likewise: theta < 1e-14 -> 0; 1 - theta < 1e-10 -> 1, above the round-off of
// overlaps.
void clean_volume_fractions(std::span<double> theta);

}  // namespace sluice::mpmice
