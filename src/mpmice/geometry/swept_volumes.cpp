#include "mpmice/geometry/swept_volumes.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "mpmice/geometry/face_moments.hpp"
#include "mpmice/geometry/pieces.hpp"
#include "mpmice/geometry/swept_rows.hpp"

namespace sluice::mpmice {
namespace {

template <int D>
constexpr int lane_of_M(int i) {
  return 2 * D + 1 + i;
}

template <int D>
void check_reach(const MixedFacet<D>& f) {
  for (const CellSpan& span : f.spans)
    if (span.high - span.low > most_move)
      throw std::out_of_range(
          fmt::format("a face of a solid reaches over {} cells in a step, at most {} are allowed",
                      span.high - span.low, most_move));
}

// Where one facet adds.
template <int D, bool WithMoments>
class FacetSums {
 public:
  FacetSums(CellSums<D>& sums, KeptArray<double>& memory)
      : cells_(sums.cells()), memory_(memory), q_(sums.lane(SweptSums<D>::lane_of_q)) {
    for (int d = 0; d < D; ++d) {
      const auto a = static_cast<std::size_t>(d);
      A_[a] = sums.lane(SweptSums<D>::lane_of_A(d));
      C_[a] = sums.lane(SweptSums<D>::lane_of_C(d));
    }
    if constexpr (WithMoments)
      for (int i = 0; i < face_moments<D>; ++i)
        M_[static_cast<std::size_t>(i)] = sums.lane(lane_of_M<D>(i));
  }

  // `weight`: all sums are linear in the areas of the facet. Cuts of inner facets that lie in a
  // grid plane belong by halves to the cells on both sides, as everywhere (pieces.hpp).
  void add(const MixedFacet<D>& f, double weight, bool inner) {
    check_reach<D>(f);
    SweptRows<D> rows(f, memory_);
    for_each_cut<D>(f, [&](const std::array<Slots, D>& slots, const FacetNodes<D>& nodes) {
      std::array<double, D> N = f.mean_area(slots);
      for (double& n : N) n *= weight;
      if (!inner || !in_grid_plane<D>(nodes)) {
        add_cut(f, slots, nodes, N, N, 1, weight, rows);
        return;
      }
      std::array<double, D> back = N;
      for (double& n : back) n = -n;
      add_cut(f, slots, nodes, N, N, 0.5, weight, rows);
      add_cut(f, slots, nodes, N, back, 0.5, weight, rows);
    });
    for (int d = 0; d < D; ++d) {
      const auto a = static_cast<std::size_t>(d);
      if (f.is_split[a]) rows.add_to(d, cells_, C_[a]);
    }
  }

 private:
  // A share of a cut; pieces in grid planes lie in the cells to which `look` points.
  void add_cut(const MixedFacet<D>& f, const std::array<Slots, D>& slots,
               const FacetNodes<D>& nodes, const std::array<double, D>& N,
               const std::array<double, D>& look, double share, double weight, SweptRows<D>& rows) {
    const auto of_share = [&](Moments<D> piece) {
      piece.s *= share;
      for (double& m : piece.m) m *= share;
      return piece;
    };
    if constexpr (WithMoments) {
      const FaceMoments<D> moments(f, slots, f.mean_area(slots));
      cut_facet<D>(nodes, f.spans, look, [&](const Cell<D>& cell, const Moments<D>& whole) {
        const Moments<D> piece = of_share(whole);
        add_piece(f, slots, nodes, N, cell, piece, rows);
        add_moments(moments, cell, piece, weight);
      });
    } else {
      cut_facet<D>(nodes, f.spans, look, [&](const Cell<D>& cell, const Moments<D>& whole) {
        add_piece(f, slots, nodes, N, cell, of_share(whole), rows);
      });
    }
  }

  // A, q, and Nl, Tl for C.
  void add_piece(const MixedFacet<D>& f, const std::array<Slots, D>& slots,
                 const FacetNodes<D>& nodes, const std::array<double, D>& N, const Cell<D>& cell,
                 const Moments<D>& piece, SweptRows<D>& rows) {
    const std::size_t c = cells_.index_to_add(cell), here = rows.any ? rows.cells.index(cell) : 0;
    double swept = 0;
    for (std::size_t d = 0; d < D; ++d) {
      double moved = 0, arm = 0;
      for (std::size_t k = 0; k < D; ++k) {
        moved += piece.m[k] * f.move[d][k];
        arm += piece.m[k] * (nodes[k][d] - cell[d]);
      }
      A_[d][c] += to_sum(N[d] * piece.s);
      swept += N[d] * moved;
      if (f.is_split[d]) rows.add(d, here, slots[d].first == 1 ? 1 : -1, N[d], piece.s, arm, moved);
    }
    q_[c] += to_sum(swept);
  }

  void add_moments(const FaceMoments<D>& moments, const Cell<D>& cell, const Moments<D>& piece,
                   double weight) {
    const std::size_t c = cells_.index_to_add(cell);
    for (std::size_t u = 0; u < D; ++u) {
      const std::array<double, D> moment = moments.of(u, cell[u], piece.m);
      for (std::size_t d = 0; d < D; ++d)
        if (d != u) M_[d * (D - 1) + (u < d ? u : u - 1)][c] += to_sum(weight * moment[d]);
    }
  }

  const CellBlocks<D>& cells_;
  KeptArray<double>& memory_;  // of SweptRows
  std::uint64_t* q_;
  std::array<std::uint64_t*, D> A_, C_;
  std::array<std::uint64_t*, face_moments<D>> M_{};
};

}  // namespace

template <int D>
void SweptSums<D>::begin(const CellBlocks<D>& cells, bool with_moments) {
  with_moments_ = with_moments;
  sums_.begin(cells, 2 * D + 1 + (with_moments ? face_moments<D> : 0));
}

template <int D>
void SweptSums<D>::add_facet(const OuterFaces<D>& faces, std::size_t i, int t) {
  const MixedFacet<D> facet(facet_nodes<D>(faces.start, i, t), facet_nodes<D>(faces.end, i, t),
                            faces.face[i]);
  if (with_moments_)
    FacetSums<D, true>(sums_, local_).add(facet, faces.weight_of(i), faces.is_inner(i));
  else
    FacetSums<D, false>(sums_, local_).add(facet, faces.weight_of(i), faces.is_inner(i));
}

template <int D>
void SweptSums<D>::add(const OuterFaces<D>& faces, std::size_t begin, std::size_t end) {
  for (std::size_t i = begin; i < end; ++i)
    for (int t = 0; t < facets_of_face<D>; ++t) add_facet(faces, i, t);
}

template <int D>
void SweptSums<D>::finish(SweptVolumes<D>& to, const CoveredSides<D>* sides) {
  for (int lane = 0; lane <= 2 * D && sides != nullptr; ++lane) sums_.fold(sides->sides(), lane);
  sums_.values(SweptSums<D>::lane_of_q, to.q);
  for (int d = 0; d < D; ++d) {
    const auto a = static_cast<std::size_t>(d);
    if (sides != nullptr) sides->add_to(d, sums_.lane(lane_of_A(d)));
    sums_.add_from_above(lane_of_A(d), d);
    sums_.values(lane_of_A(d), to.A[a]);
    sums_.values(lane_of_C(d), to.C[a]);
  }
  for (int i = 0; i < face_moments<D>; ++i) {
    const auto at = static_cast<std::size_t>(i);
    to.M[at].clear();
    if (!with_moments_) continue;
    sums_.add_from_above(lane_of_M<D>(i), i / (D > 1 ? D - 1 : 1));
    sums_.values(lane_of_M<D>(i), to.M[at]);
  }
}

template class SweptSums<1>;
template class SweptSums<2>;
template class SweptSums<3>;

}  // namespace sluice::mpmice
