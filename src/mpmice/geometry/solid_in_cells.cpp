#include "mpmice/geometry/solid_in_cells.hpp"

#include "mpmice/geometry/pieces.hpp"

namespace sluice::mpmice {

template <int D>
void SolidSums<D>::add_piece(const Piece<D>& piece, const FacetNodes<D>& nodes, double weight) {
  const std::size_t c = sums_.cells().index_to_add(piece.cell);
  for (int d = 0; d < D; ++d)
    sums_.lane(d)[c] += to_sum(weight * piece.area[static_cast<std::size_t>(d)]);
  double first = 0;
  for (std::size_t k = 0; k < D; ++k) first += piece.m[k] * (nodes[k][0] - piece.cell[0]);
  sums_.lane(D)[c] += to_sum(weight * (piece.n[0] * first));
}

template <int D>
void SolidSums<D>::add_facet(const OuterFaces<D>& faces, When when, std::size_t i, int t) {
  for_each_piece_of<D>(faces, when, i, t,
                       [&](std::size_t, int, const FacetNodes<D>& nodes, const Piece<D>& piece) {
                         add_piece(piece, nodes, faces.weight_of(i));
                       });
}

template <int D>
void SolidSums<D>::add(const OuterFaces<D>& faces, When when, std::size_t begin, std::size_t end) {
  for (std::size_t i = begin; i < end; ++i)
    for (int t = 0; t < facets_of_face<D>; ++t) add_facet(faces, when, i, t);
}

template <int D>
void SolidSums<D>::add(const OuterFaces<D>& faces, const CutSurface<D>& pieces) {
  pieces.for_each(faces,
                  [&](std::size_t i, int, const FacetNodes<D>& nodes, const Piece<D>& piece) {
                    add_piece(piece, nodes, faces.weight_of(i));
                  });
}

template <int D>
void SolidSums<D>::finish(SolidInCells<D>& to, const CoveredSides<D>* sides) {
  for (int lane = 0; lane <= D && sides != nullptr; ++lane) sums_.fold(sides->sides(), lane);
  for (int d = 0; d < D; ++d) {
    const auto a = static_cast<std::size_t>(d);
    sums_.values(d, to.n[a]);
    if (sides != nullptr) sides->add_to(d, sums_.lane(d));
    sums_.add_from_above(d, d);
    sums_.values(d, to.a[a]);
  }
  // theta = a_x(upper) + T_x
  std::uint64_t* T = sums_.lane(D);
  const std::uint64_t* a = sums_.lane(0);
  const CellBlocks<D>& cells = sums_.cells();
  for (std::size_t i = CellBlocks<D>::block_cells; i < cells.size(); ++i)
    T[i] += a[cells.cell_above(i, 0)];
  sums_.values(D, to.theta);
}

void clean_covered_parts(std::span<double> a) {
  for (double& x : a) x = x < 1e-14 ? 0.0 : x > 1 - 1e-14 ? 1.0 : x;
}

void clean_volume_fractions(std::span<double> theta) {
  for (double& x : theta) x = x < 1e-14 ? 0.0 : 1 - x < 1e-10 ? 1.0 : x;
}

template class SolidSums<1>;
template class SolidSums<2>;
template class SolidSums<3>;

}  // namespace sluice::mpmice
