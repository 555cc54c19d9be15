#include "mpmice/geometry/swept_volumes.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "mpmice/geometry/mean_pieces.hpp"
#include "mpmice/geometry/solid_in_cells.hpp"
#include "mpmice/geometry/swept_rows.hpp"

namespace sluice::mpmice {
namespace {

template <int D>
void check_reach(const MixedFacet<D>& f) {
  for (const CellSpan& span : f.spans)
    if (span.high - span.low > most_move)
      throw std::out_of_range(
          fmt::format("a face of a solid reaches over {} cells in a step, at most {} are allowed",
                      span.high - span.low, most_move));
}

}  // namespace

template <int D>
void SweptSums<D>::add_facet(const OuterFaces<D>& faces, std::size_t i, int t, FreeCells<D>& free) {
  const MixedFacet<D> f(facet_nodes<D>(faces.start, i, t), facet_nodes<D>(faces.end, i, t),
                        faces.face[i]);
  check_reach<D>(f);
  free.mark_spans(f.base, f.spans);
  SweptRows<D> rows(f, local_);
  for_each_mean_piece<D>(
      f, faces.weight_of(i), faces.is_inner(i),
      [&](const std::array<Slots, D>& slots, const MeanArea<D>& area, const MeanPiece<D>& piece) {
        Cell<D> cell = piece.cell;
        for (std::size_t d = 0; d < D; ++d) cell[d] += f.base[d];
        const std::size_t c = sums_.cells().index_to_add(cell);
        const std::size_t here = rows.any ? rows.cells.index(piece.cell) : 0;
        for (int a = 0; a < D; ++a) {
          const auto d = static_cast<std::size_t>(a);
          sums_.lane(lane_of_N(a))[c] += to_sum(area.N[d] * piece.s);
          sums_.lane(lane_of_T(a))[c] += to_sum(piece.T[d]);
          if (!f.is_split[d]) continue;
          const int slot = slots[d].first;
          double moved = 0, arm = 0;
          for (std::size_t k = 0; k < D; ++k) {
            moved += piece.m[k] * f.move[d][k];
            arm += piece.m[k] * (f.x[static_cast<std::size_t>(slot)][k][d] - piece.cell[d]);
          }
          rows.add(d, here, slot == 1 ? 1 : -1, area, piece.s, arm, moved);
        }
      });
  for (int d = 0; d < D; ++d)
    if (f.is_split[static_cast<std::size_t>(d)])
      rows.add_to(d, f.base, sums_.cells(), sums_.lane(lane_of_C(d)));
}

template <int D>
void SweptSums<D>::add(const OuterFaces<D>& faces, std::size_t begin, std::size_t end,
                       FreeCells<D>& free) {
  for (std::size_t i = begin; i < end; ++i)
    for (int t = 0; t < facets_of_face<D>; ++t) add_facet(faces, i, t, free);
}

template <int D>
void SweptSums<D>::finish(const FreeCells<D>& free, const std::uint64_t* references,
                          SweptVolumes<D>& to) {
  for (int lane = 0; lane < sums_.lanes(); ++lane) sums_.fold(free.sides(), lane);
  find_covered_parts<D>(free, sums_, references, theta_, to.A);
  for (int d = 0; d < D; ++d) {
    KeptArray<double>& C = to.C[static_cast<std::size_t>(d)];
    sums_.values(lane_of_C(d), C);
    copy_images(free.cells(), free.sides(), C);
  }
}

template class SweptSums<1>;
template class SweptSums<2>;
template class SweptSums<3>;

}  // namespace sluice::mpmice
