#include "mpmice/geometry/solid_in_cells.hpp"

#include "mpmice/geometry/pieces.hpp"

namespace sluice::mpmice {

template <int D>
void SolidSums<D>::add_piece(const Piece<D>& piece, double weight, FreeCells<D>* free) {
  const std::size_t c = sums_.cells().index_to_add(piece.cell);
  for (int d = 0; d < D; ++d) {
    const auto a = static_cast<std::size_t>(d);
    sums_.lane(d)[c] += to_sum(weight * piece.area[a]);
    sums_.lane(D + d)[c] += to_sum(weight * (piece.n[a] * piece.arm[a]));
  }
  if (free != nullptr) free->marks()[c] += 1;
}

template <int D>
void SolidSums<D>::add_facet(const OuterFaces<D>& faces, When when, std::size_t i, int t,
                             FreeCells<D>* free) {
  for_each_piece_of<D>(faces, when, i, t, [&](std::size_t, int, const Piece<D>& piece) {
    add_piece(piece, faces.weight_of(i), free);
  });
}

template <int D>
void SolidSums<D>::add(const OuterFaces<D>& faces, When when, std::size_t begin, std::size_t end,
                       FreeCells<D>* free) {
  for (std::size_t i = begin; i < end; ++i)
    for (int t = 0; t < facets_of_face<D>; ++t) add_facet(faces, when, i, t, free);
}

template <int D>
void SolidSums<D>::add(const OuterFaces<D>& faces, const CutSurface<D>& pieces,
                       FreeCells<D>& free) {
  pieces.for_each(faces, [&](std::size_t i, int, const Piece<D>& piece) {
    add_piece(piece, faces.weight_of(i), &free);
  });
}

template <int D>
void SolidSums<D>::finish(const FreeCells<D>& free, const std::uint64_t* references,
                          SolidInCells<D>& to) {
  for (int lane = 0; lane < sums_.lanes(); ++lane) sums_.fold(free.sides(), lane);
  find_covered_parts<D>(free, sums_, references, theta_, to.a);
  to.theta.resize(theta_.size());
  for (std::size_t i = 0; i < theta_.size(); ++i) to.theta[i] = from_sum(theta_[i]);
  copy_images(free.cells(), free.sides(), to.theta);
  for (int d = 0; d < D; ++d) {
    KeptArray<double>& n = to.n[static_cast<std::size_t>(d)];
    sums_.values(d, n);
    copy_images(free.cells(), free.sides(), n);
  }
}

template <int D>
void find_covered_parts(const FreeCells<D>& free, const CellSums<D>& sums,
                        const std::uint64_t* references, KeptArray<std::uint64_t>& theta,
                        std::array<KeptArray<double>, D>& a) {
  LanesOfDirections<D> N, T;
  for (int d = 0; d < D; ++d) {
    N[static_cast<std::size_t>(d)] = sums.lane(d);
    T[static_cast<std::size_t>(d)] = sums.lane(D + d);
  }
  follow_cells<D>(free, N, T, references, theta);
  for (std::size_t d = 0; d < D; ++d) {
    a[d].resize(theta.size());
    for (std::size_t i = 0; i < theta.size(); ++i) a[d][i] = from_sum(theta[i] - T[d][i] + N[d][i]);
    copy_images(free.cells(), free.sides(), a[d]);
  }
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
template void find_covered_parts<1>(const FreeCells<1>&, const CellSums<1>&, const std::uint64_t*,
                                    KeptArray<std::uint64_t>&, std::array<KeptArray<double>, 1>&);
template void find_covered_parts<2>(const FreeCells<2>&, const CellSums<2>&, const std::uint64_t*,
                                    KeptArray<std::uint64_t>&, std::array<KeptArray<double>, 2>&);
template void find_covered_parts<3>(const FreeCells<3>&, const CellSums<3>&, const std::uint64_t*,
                                    KeptArray<std::uint64_t>&, std::array<KeptArray<double>, 3>&);

}  // namespace sluice::mpmice
