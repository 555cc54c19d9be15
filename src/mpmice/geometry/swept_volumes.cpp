#include "mpmice/geometry/swept_volumes.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "mpmice/geometry/mixed_facet.hpp"

namespace sluice::mpmice {
namespace {

constexpr int lane_of_A(int d) {
  return d;
}
template <int D>
constexpr int lane_of_C(int d) {
  return D + d;
}
template <int D>
constexpr int lane_of_q = 2 * D;
template <int D>
constexpr int lane_of_M(int i) {
  return 2 * D + 1 + i;
}

}  // namespace

// Nl and Tl of one facet in the box of its own cells, for the directions that are split.
template <int D>
struct SweptSums<D>::Facet {
  CellBox<D> cells;
  std::size_t n = 0;
  std::array<double*, D> Nl{}, Tl{};

  Facet(const MixedFacet<D>& f, std::vector<double>& memory) {
    std::size_t split = 0;
    for (std::size_t d = 0; d < D; ++d) {
      cells.lower[d] = f.spans[d].low;
      cells.upper[d] = f.spans[d].high + 1;
      if (f.spans[d].high - f.spans[d].low > most_move)
        throw std::out_of_range(
            fmt::format("a face of a solid reaches over {} cells in a step, at most {} are allowed",
                        f.spans[d].high - f.spans[d].low, most_move));
      split += f.is_split[d] ? 1 : 0;
    }
    if (split == 0) return;
    n = cells.cells();
    memory.assign(2 * split * n, 0.0);
    double* next = memory.data();
    for (std::size_t d = 0; d < D; ++d)
      if (f.is_split[d]) {
        Nl[d] = next;
        Tl[d] = next + n;
        next += 2 * n;
      }
  }

  // C of the lower faces of all but the lowest cells: there W is 0.
  void add_C(int d, CellSums<D>& sums) const;
};

template <int D>
void SweptSums<D>::Facet::add_C(int d, CellSums<D>& sums) const {
  const auto a = static_cast<std::size_t>(d);
  const CellBox<D>& box = sums.box();
  std::uint64_t* C = sums.lane(lane_of_C<D>(d));
  CellBox<D> tops = cells;
  tops.lower[a] = tops.upper[a] - 1;
  const std::ptrdiff_t step = cells.stride(d), stride = box.stride(d);
  Cell<D> cell = tops.lower;
  for (std::size_t row = tops.cells(); row-- > 0;) {
    auto from = static_cast<std::ptrdiff_t>(cells.index(cell));
    auto to = static_cast<std::ptrdiff_t>(box.index(cell));
    double W = 0, B = 0;
    for (int i = cells.size(d); i-- > 1; from -= step, to -= stride) {
      W += B + Tl[a][from];
      B += Nl[a][from];
      C[to] += to_sum(W);
    }
    for (std::size_t k = 0; k < D; ++k) {  // the next row
      if (++cell[k] < tops.upper[k]) break;
      cell[k] = tops.lower[k];
    }
  }
}

template <int D>
void SweptSums<D>::begin(const CellBox<D>& box, bool with_moments) {
  with_moments_ = with_moments;
  sums_.begin(box, 2 * D + 1 + (with_moments ? face_moments<D> : 0));
}

namespace {

// Adds the moments M_du of one piece, over both slots of u where its cut is shared.
template <int D>
void add_face_moments(const MixedFacet<D>& f, const std::array<Slots, D>& slots,
                      const Cell<D>& cell, const Moments<D>& piece, std::size_t c,
                      CellSums<D>& sums) {
  for (std::size_t u = 0; u < D; ++u) {
    std::array<double, D> moment{};
    for (int b = slots[u].first; b <= slots[u].last; ++b) {
      std::array<Slots, D> one = slots;
      one[u] = {b, b};
      const std::array<double, D> N = f.mean_area(one);
      double arm = 0;
      for (std::size_t k = 0; k < D; ++k)
        arm += piece.m[k] * (f.x[static_cast<std::size_t>(b)][k][u] - (cell[u] + 0.5));
      for (std::size_t d = 0; d < D; ++d) moment[d] += N[d] * arm;
    }
    for (std::size_t d = 0; d < D; ++d)
      if (d != u) {
        const std::size_t i = d * (D - 1) + (u < d ? u : u - 1);
        sums.lane(lane_of_M<D>(static_cast<int>(i)))[c] += to_sum(moment[d]);
      }
  }
}

}  // namespace

template <int D>
void SweptSums<D>::add(const OuterFaces<D>& faces, std::size_t begin, std::size_t end) {
  sums_.reach(cells_reached<D>(faces, begin, end));
  const CellBox<D>& box = sums_.box();
  std::array<std::uint64_t*, D> A;
  for (int d = 0; d < D; ++d) A[static_cast<std::size_t>(d)] = sums_.lane(lane_of_A(d));
  std::uint64_t* q = sums_.lane(lane_of_q<D>);
  for (std::size_t i = begin; i < end; ++i)
    for (int t = 0; t < facets_of_face<D>; ++t) {
      const MixedFacet<D> f(facet_nodes<D>(faces.start, i, t), facet_nodes<D>(faces.end, i, t),
                            faces.face[i]);
      const Facet own(f, local_);
      for_each_cut<D>(f, [&](const std::array<Slots, D>& slots, const FacetNodes<D>& nodes) {
        const std::array<double, D> N = f.mean_area(slots);
        cut_facet<D>(nodes, f.spans, N, [&](const Cell<D>& cell, const Moments<D>& piece) {
          const std::size_t c = box.index(cell), here = own.n > 0 ? own.cells.index(cell) : 0;
          double swept = 0;
          for (std::size_t d = 0; d < D; ++d) {
            double moved = 0, arm = 0;
            for (std::size_t k = 0; k < D; ++k) {
              moved += piece.m[k] * f.move[d][k];
              arm += piece.m[k] * (nodes[k][d] - cell[d]);
            }
            A[d][c] += to_sum(N[d] * piece.s);
            swept += N[d] * moved;
            if (own.Nl[d] != nullptr) {  // sigma w n_d = 2 sigma N_d: one slot of d
              const double turn = slots[d].first == 1 ? 2 * N[d] : -2 * N[d];
              own.Nl[d][here] += turn * piece.s;
              own.Tl[d][here] += turn * arm - N[d] * moved;
            }
          }
          q[c] += to_sum(swept);
          if (with_moments_) add_face_moments<D>(f, slots, cell, piece, c, sums_);
        });
      });
      for (int d = 0; d < D; ++d)
        if (f.is_split[static_cast<std::size_t>(d)]) own.add_C(d, sums_);
    }
}

template <int D>
void SweptSums<D>::finish(SweptVolumes<D>& to) {
  to.box = sums_.box();
  sums_.values(lane_of_q<D>, to.q);
  for (int d = 0; d < D; ++d) {
    const auto a = static_cast<std::size_t>(d);
    sums_.add_from_above(lane_of_A(d), d);
    sums_.values(lane_of_A(d), to.A[a]);
    sums_.values(lane_of_C<D>(d), to.C[a]);
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
