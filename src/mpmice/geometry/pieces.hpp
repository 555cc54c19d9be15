// The pieces of outer faces in cells, at the start or at the end of a step.
#pragma once

#include "mpmice/geometry/cut.hpp"

namespace sluice::mpmice {

template <int D>
struct Piece {
  Cell<D> cell;
  std::array<double, D> area;  // outward, in faces of a cell
  double s;                    // its share of the area of the facet
  // int l_k over the piece for the nodes k of the facet, sum s: what is linear on the facet has the
  // integral |n| sum_k m_k f_k. A pressure p on the piece puts -p n m_k on node k, and
  // add_to_corners carries that on to the corners of the face.
  std::array<double, D> m;
  std::array<double, D> n;  // area vector of the whole facet: area = n s
};

// act(i, t, nodes, piece): facet t of face i.
template <int D, class Act>
void for_each_piece(const OuterFaces<D>& faces, When when, std::size_t begin, std::size_t end,
                    Act&& act) {
  const auto& x = when == When::start ? faces.start : faces.end;
  for (std::size_t i = begin; i < end; ++i)
    for (int t = 0; t < facets_of_face<D>; ++t) {
      const FacetNodes<D> nodes = facet_nodes<D>(x, i, t);
      const std::array<double, D> n = area_vector<D>(nodes, faces.face[i]);
      std::array<CellSpan, D> spans;
      for (int d = 0; d < D; ++d) {
        const auto a = static_cast<std::size_t>(d);
        spans[a] = span_along<D>(nodes, d, n[a]);
      }
      cut_facet<D>(nodes, spans, n, [&](const Cell<D>& cell, const Moments<D>& moments) {
        Piece<D> piece{cell, {}, moments.s, moments.m, n};
        for (std::size_t d = 0; d < D; ++d) piece.area[d] = n[d] * moments.s;
        act(i, t, nodes, piece);
      });
    }
}

}  // namespace sluice::mpmice
