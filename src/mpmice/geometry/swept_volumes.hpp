// What solids sweep in a step: time means of covered parts of faces, volumes through faces, volumes
// into cells.
//
// With mixed shapes of the outer facets (mixed_facet.hpp), sigma = +1 where the coordinate along d
// is new, -1 where it is old, xi = new - old place:
//
//   A_d: N_d of all shapes with weights w/2, summed down the rows: time mean of a
//   q_c = sum_d sum (w/2) n_d (sum_k m_k xi_k)_d: volume that the surface in c adds to the solid
//   C of a face, from each facet in the box of its own cells, down each row along d from the top:
//       Nl = sum sigma w n_d s,  Tl = sum sigma w n_d (m.(P - X))_d - (w/2) n_d (m.xi)_d,
//       W += B + Tl;  B += Nl;  C(lower face) += W
//   M_du: n_d (m.P - s X_mid)_u with weights w/2, summed down the rows: first moments of the
//       covered part of a face about its middle, along a tangential direction u
//
// Identity:  theta' - theta = q_c + sum_d (C_d(lower) - C_d(upper)).
// The volume of solid that passes a face, per cell volume, is
//
//   H_s = C + dt (A v + sum_u M_du d_u v),
//
// v the solid's velocity at the face's middle in cells per time, d_u v its slopes; A v alone is the
// simplest form. In uniform motion the fluid's volume is kept: q_c = sum_d xi_d (A(lower) -
// A(upper)). C is exactly 0 at faces that no facet crosses.
#pragma once
#include "mpmice/geometry/cell_sums.hpp"
#include "mpmice/geometry/covered_sides.hpp"

namespace sluice::mpmice {

template <int D>
inline constexpr int face_moments = D * (D - 1);

// Arrays over the cells of blocks, zero where no surface is near.
template <int D>
struct SweptVolumes {
  KeptArray<double> q;
  std::array<KeptArray<double>, D> A, C;  // lower faces along d
  // M_du of lower faces, [d (D - 1) + j]: u is the j-th other direction, rising. Empty unless asked
  // for.
  std::array<KeptArray<double>, face_moments<D>> M;
};

template <int D>
class SweptSums {
 public:
  // Keeps a reference to the blocks.
  void begin(const CellBlocks<D>& cells, bool with_moments = false);
  // Faces begin to end - 1. Throws std::out_of_range where a piece lies in no block.
  void add(const OuterFaces<D>& faces, std::size_t begin, std::size_t end);
  // Facet t of face i.
  void add_facet(const OuterFaces<D>& faces, std::size_t i, int t);
  // Lanes A_d, C_d, q; then those of the moments.
  CellSums<D>& sums() { return sums_; }
  static constexpr int lane_of_A(int d) { return d; }
  static constexpr int lane_of_C(int d) { return D + d; }
  static constexpr int lane_of_q = 2 * D;
  void merge(const SweptSums& other) { sums_.merge(other.sums_); }
  void sum_over_ranks(Communicator& ranks) { sums_.sum_over_ranks(ranks); }
  // Uses up the sums: begin() is next. `sides` (add_mean): across periodic ones; moments are not
  // known there.
  void finish(SweptVolumes<D>& to, const CoveredSides<D>* sides = nullptr);

 private:
  bool with_moments_ = false;
  CellSums<D> sums_;         // lanes A, C, q, M
  KeptArray<double> local_;  // Nl, Tl of one facet; keeps its memory
};

}  // namespace sluice::mpmice
