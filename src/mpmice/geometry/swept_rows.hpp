// C of one facet: rows along each split direction in the box of its own cells.
//
//   Nl = sum sigma P_d s,  Tl = sum sigma P_d (m.(P - X))_d - N_d (m.xi)_d;
//   down each row from the top:  W += B + Tl;  B += Nl;  C(lower face) += W
//
// (swept_volumes.hpp). At the end of a row W = B = 0: nothing is left for the cells beyond, and no
// round-off of one facet is carried through the cells of another.
#pragma once
#include <vector>

#include "mpmice/geometry/cell_sums.hpp"
#include "mpmice/geometry/mixed_facet.hpp"

namespace sluice::mpmice {

template <int D>
struct SweptRows {
  CellBox<D> cells;
  bool any = false;                   // is a direction split
  std::array<double*, D> Nl{}, Tl{};  // null along directions that are not split

  // `memory` holds the numbers, and keeps its capacity.
  SweptRows(const MixedFacet<D>& f, KeptArray<double>& memory) {
    std::size_t split = 0;
    for (std::size_t d = 0; d < D; ++d) {
      cells.lower[d] = f.spans[d].low;
      cells.upper[d] = f.spans[d].high + 1;
      split += f.is_split[d] ? 1 : 0;
    }
    any = split > 0;
    if (!any) return;
    const std::size_t n = cells.cells();
    memory.assign(2 * split * n, 0.0);
    double* next = memory.data();
    for (std::size_t d = 0; d < D; ++d)
      if (f.is_split[d]) {
        Nl[d] = next;
        Tl[d] = next + n;
        next += 2 * n;
      }
  }

  // A piece of a cut at the old (sign -1) or new places along d (mixed_facet.hpp); `arm` =
  // (m.(P - X))_d, `moved` = (m.xi)_d.
  void add(std::size_t d, std::size_t at, double sign, const MeanArea<D>& area, double s,
           double arm, double moved) {
    Nl[d][at] += sign * area.P[d] * s;
    Tl[d][at] += sign * area.P[d] * arm - area.N[d] * moved;
  }

  // C along d of the lower faces of all but the lowest cells, into an array over blocks; cells are
  // counted from `base`.
  void add_to(int d, const Cell<D>& base, const CellBlocks<D>& blocks, std::uint64_t* C) const {
    const auto a = static_cast<std::size_t>(d);
    CellBox<D> tops = cells;
    tops.lower[a] = tops.upper[a] - 1;
    const std::ptrdiff_t step = cells.stride(d);
    Cell<D> cell = tops.lower;
    for (std::size_t row = tops.cells(); row-- > 0;) {
      auto from = static_cast<std::ptrdiff_t>(cells.index(cell));
      Cell<D> face = cell;
      for (std::size_t k = 0; k < D; ++k) face[k] += base[k];
      double W = 0, B = 0;
      for (int i = cells.size(d); i-- > 1; from -= step, --face[a]) {
        W += B + Tl[a][from];
        B += Nl[a][from];
        C[blocks.index_to_add(face)] += to_sum(W);
      }
      for (std::size_t k = 0; k < D; ++k) {  // the next row
        if (++cell[k] < tops.upper[k]) break;
        cell[k] = tops.lower[k];
      }
    }
  }
};

}  // namespace sluice::mpmice
