// What solids sweep in a step: time means of covered parts of faces, volumes through faces.
//
// With mixed shapes of the outer facets and their weights (mixed_facet.hpp), sigma = +1 where the
// coordinate along d is new, -1 where it is old, xi = new - old place:
//
//   A_d: time mean of a, from N_d = sum W n_d s, T_d = sum W n_d (m.(P - X))_d as a from its own
//       sums (solid_in_cells.hpp): the weights W are the same for all directions, so that
//       Theta = A_d(upper) + T_d is, too
//   C of a face, from each facet in the box of its own cells, down each row along d from the top:
//       Nl = sum sigma P_d s,  Tl = sum sigma P_d (m.(P - X))_d - N_d (m.xi)_d,
//       W += B + Tl;  B += Nl;  C(lower face) += W
//
// With q_c = sum_d sum N_d (m.xi)_d, the volume that the surface in c adds to the solid:
//
//   theta' - theta = q_c + sum_d (C_d(lower) - C_d(upper)).
//
// The volume of solid that passes a face, per cell volume, is H_s = C + dt A v, v the solid's
// velocity at the face in cells per time. In uniform motion the fluid's volume is kept:
// q_c = sum_d xi_d (A(lower) - A(upper)). C is exactly 0 at faces that no facet crosses.
#pragma once
#include "mpmice/geometry/free_cells.hpp"

namespace sluice::mpmice {

// Arrays over the cells of blocks, zero where no surface is near.
template <int D>
struct SweptVolumes {
  std::array<KeptArray<double>, D> A, C;  // lower faces along d
};

template <int D>
class SweptSums {
 public:
  // Keeps a reference to the blocks.
  void begin(const CellBlocks<D>& cells) { sums_.begin(cells, 3 * D); }
  // Faces begin to end - 1; marks the cells that they span. Throws std::out_of_range where one has
  // no block.
  void add(const OuterFaces<D>& faces, std::size_t begin, std::size_t end, FreeCells<D>& free);
  // Facet t of face i.
  void add_facet(const OuterFaces<D>& faces, std::size_t i, int t, FreeCells<D>& free);
  CellSums<D>& sums() { return sums_; }  // lanes N_d, T_d, C_d
  static constexpr int lane_of_N(int d) { return d; }
  static constexpr int lane_of_T(int d) { return D + d; }
  static constexpr int lane_of_C(int d) { return 2 * D + d; }
  void merge(const SweptSums& other) { sums_.merge(other.sums_); }
  void sum_over_ranks(Communicator& ranks) { sums_.sum_over_ranks(ranks); }
  // Uses up the sums: begin() is next. `references`: Theta of the lowest cells of blocks that begin
  // there.
  void finish(const FreeCells<D>& free, const std::uint64_t* references, SweptVolumes<D>& to);

 private:
  CellSums<D> sums_;
  KeptArray<double> local_;         // Nl, Tl of one facet; keeps its memory
  KeptArray<std::uint64_t> theta_;  // its mean
};

}  // namespace sluice::mpmice
