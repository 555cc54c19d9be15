#include "mpmice/geometry/solid_in_cells.hpp"

#include "mpmice/geometry/open_rows.hpp"
#include "mpmice/geometry/pieces.hpp"

namespace sluice::mpmice {

template <int D>
void SolidSums<D>::add(const OuterFaces<D>& faces, When when, std::size_t begin, std::size_t end) {
  sums_.reach(cells_reached<D>(faces, begin, end));
  const CellBox<D>& box = sums_.box();
  std::array<std::uint64_t*, D + 1> lanes;
  for (int i = 0; i <= D; ++i) lanes[static_cast<std::size_t>(i)] = sums_.lane(i);
  for_each_piece<D>(faces, when, begin, end,
                    [&](std::size_t i, int, const FacetNodes<D>& nodes, const Piece<D>& piece) {
                      const std::size_t c = box.index(piece.cell);
                      const double weight = faces.weight_of(i);
                      for (std::size_t d = 0; d < D; ++d)
                        lanes[d][c] += to_sum(weight * piece.area[d]);
                      double first = 0;
                      for (std::size_t k = 0; k < D; ++k)
                        first += piece.m[k] * (nodes[k][0] - piece.cell[0]);
                      lanes[D][c] += to_sum(weight * (piece.n[0] * first));
                    });
}

template <int D>
void SolidSums<D>::finish(SolidInCells<D>& to, const CoveredSides<D>* sides) {
  to.box = sums_.box();
  const Cell<D> high = sums_.reached().upper;
  for (int lane = 0; lane <= D && sides != nullptr; ++lane) sums_.fold(sides->sides(), lane);
  for (int d = 0; d < D; ++d) {
    const auto a = static_cast<std::size_t>(d);
    sums_.values(d, to.n[a]);
    if (sides != nullptr) sides->add_to(d, sums_.lane(d));
    sums_.add_from_above(d, d);
    sums_.values(d, to.a[a]);
  }
  // theta = a_x(upper) + T_x; a is 0 beyond the high end.
  std::uint64_t* T = sums_.lane(D);
  const std::uint64_t* a = sums_.lane(0);
  for_each_row_down<D>(sums_.box(), sums_.reached(), 0, [&](std::size_t first, std::size_t n) {
    for (std::size_t i = first; i + 1 < first + n; ++i) T[i] += a[i + 1];
  });
  sums_.values(D, to.theta);
  for (int d = 0; d < D; ++d)
    if (sides == nullptr || !sides->sides().periodic[static_cast<std::size_t>(d)])
      raise_open_rows<D>(to.box, sums_.reached(), d, high[static_cast<std::size_t>(d)],
                         to.a[static_cast<std::size_t>(d)], d == 0 ? &to.theta : nullptr);
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
