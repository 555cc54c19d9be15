// The pieces in cells of all mixed shapes of a moving facet: what it covers in the mean of a step.
#pragma once
#include "mpmice/geometry/mixed_facet.hpp"
#include "mpmice/geometry/pieces.hpp"

namespace sluice::mpmice {

template <int D>
struct MeanPiece {
  Cell<D> cell;  // counted from the facet's base
  double s;
  std::array<double, D> m;  // as of a Piece
  // Sums over the shapes of the cut: W n_d (m.(P - X))_d, from the lower corner X of the cell.
  std::array<double, D> T;
};

// act(slots, area, piece); `weight`: all is linear in the areas of the facet. Cuts of inner facets
// that lie in a grid plane belong by halves to the cells on both sides, as everywhere (pieces.hpp).
template <int D, class Act>
void for_each_mean_piece(const MixedFacet<D>& f, double weight, bool inner, Act&& act) {
  for_each_cut<D>(f, [&](const std::array<Slots, D>& slots, const FacetNodes<D>& nodes) {
    MeanArea<D> area(f, slots);
    area.scale(weight);
    const auto cut = [&](const std::array<double, D>& look, double share) {
      cut_facet<D>(nodes, f.spans, look, [&](const Cell<D>& cell, const Moments<D>& moments) {
        MeanPiece<D> piece{cell, share * moments.s, moments.m, {}};
        for (double& m : piece.m) m *= share;
        for (std::size_t d = 0; d < D; ++d)
          for (int slot = slots[d].first; slot <= slots[d].last; ++slot) {
            const auto b = static_cast<std::size_t>(slot);
            double arm = 0;
            for (std::size_t k = 0; k < D; ++k) arm += piece.m[k] * (f.x[b][k][d] - cell[d]);
            piece.T[d] += area.at[d][b] * arm;
          }
        act(slots, area, piece);
      });
    };
    if (!inner || !in_grid_plane<D>(nodes)) return cut(area.N, 1);
    std::array<double, D> back = area.N;
    for (double& n : back) n = -n;
    cut(area.N, 0.5);
    cut(back, 0.5);
  });
}

}  // namespace sluice::mpmice
