// The pieces of outer faces in cells, at the start or at the end of a step.
#pragma once
#include <cmath>

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
  std::array<double, D> n;    // area vector of the whole facet: area = n s
  std::array<double, D> arm;  // sum_k m_k (P_k - X), from the lower corner X of the cell
};

// Does the facet lie in a grid plane.
template <int D>
bool in_grid_plane(const FacetNodes<D>& nodes) {
  for (std::size_t a = 0; a < D; ++a) {
    bool flat = nodes[0][a] == std::floor(nodes[0][a]);
    for (std::size_t k = 1; k < D; ++k) flat = flat && nodes[k][a] == nodes[0][a];
    if (flat) return true;
  }
  return false;
}

// act(i, t, piece) for the pieces of facet t of face i. In a grid plane outer faces lie in
// the cell that they look into, inner ones half in each: both sides of one alike, so that they
// cancel in both cells.
template <int D, class Act>
void for_each_piece_of(const OuterFaces<D>& faces, When when, std::size_t i, int t, Act&& act) {
  FacetNodes<D> nodes = facet_nodes<D>(when == When::start ? faces.start : faces.end, i, t);
  const Cell<D> base = count_from_own_cell<D>(nodes);
  const std::array<double, D> n = area_vector<D>(nodes, faces.face[i]);
  const auto cut = [&](const std::array<double, D>& look, double share) {
    cut_facet<D>(nodes, spans_towards<D>(nodes, look), look,
                 [&](const Cell<D>& cell, const Moments<D>& moments) {
                   Piece<D> piece{base, {}, share * moments.s, moments.m, n, {}};
                   for (double& m : piece.m) m *= share;
                   for (std::size_t d = 0; d < D; ++d) {
                     piece.cell[d] += cell[d];
                     piece.area[d] = n[d] * piece.s;
                     for (std::size_t k = 0; k < D; ++k)
                       piece.arm[d] += piece.m[k] * (nodes[k][d] - cell[d]);
                   }
                   act(i, t, piece);
                 });
  };
  if (!faces.is_inner(i) || !in_grid_plane<D>(nodes)) return cut(n, 1);
  std::array<double, D> back = n;
  for (double& b : back) b = -b;
  cut(n, 0.5);
  cut(back, 0.5);
}

// The same for all facets of faces begin to end - 1.
template <int D, class Act>
void for_each_piece(const OuterFaces<D>& faces, When when, std::size_t begin, std::size_t end,
                    Act&& act) {
  for (std::size_t i = begin; i < end; ++i)
    for (int t = 0; t < facets_of_face<D>; ++t) for_each_piece_of<D>(faces, when, i, t, act);
}

// The pieces at the start of a step, cut once for all who ask for them.
template <int D>
class CutSurface {
 public:
  void cut(const OuterFaces<D>& faces) {
    clear();
    add(faces, 0, faces.size());
  }
  void clear() { pieces_.clear(); }
  // Those of faces begin to end - 1; those of another, which are of the faces behind.
  void add(const OuterFaces<D>& faces, std::size_t begin, std::size_t end) {
    for_each_piece<D>(
        faces, When::start, begin, end, [&](std::size_t i, int t, const Piece<D>& piece) {
          pieces_.push_back({static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(t),
                             piece.cell, piece.s, piece.m, piece.arm});
        });
  }
  void append(const CutSurface& other) {
    pieces_.insert(pieces_.end(), other.pieces_.begin(), other.pieces_.end());
  }
  std::size_t size() const { return pieces_.size(); }
  // act(i, t, piece) as for_each_piece of these faces, to the bit.
  template <class Act>
  void for_each(const OuterFaces<D>& faces, Act&& act) const {
    for_each(faces, 0, size(), act);
  }
  // The same for pieces begin to end - 1.
  template <class Act>
  void for_each(const OuterFaces<D>& faces, std::size_t begin, std::size_t end, Act&& act) const {
    Piece<D> piece{};
    const Kept* last = nullptr;
    for (std::size_t n = begin; n < end; ++n) {
      const Kept& kept = pieces_[n];
      if (last == nullptr || kept.face != last->face || kept.facet != last->facet)
        // Differences of places are the same wherever these are counted from.
        piece.n =
            area_vector<D>(facet_nodes<D>(faces.start, kept.face, static_cast<int>(kept.facet)),
                           faces.face[kept.face]);
      last = &kept;
      piece.cell = kept.cell;
      piece.s = kept.s;
      piece.m = kept.m;
      piece.arm = kept.arm;
      for (std::size_t d = 0; d < D; ++d) piece.area[d] = piece.n[d] * piece.s;
      act(static_cast<std::size_t>(kept.face), static_cast<int>(kept.facet), piece);
    }
  }

 private:
  struct Kept {
    std::uint32_t face, facet;
    Cell<D> cell;
    double s;
    std::array<double, D> m, arm;
  };
  KeptArray<Kept> pieces_;
};

}  // namespace sluice::mpmice
