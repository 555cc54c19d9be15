#include "mpmice/geometry/covered_sides.hpp"

#include <cmath>

#include "mpmice/geometry/mixed_facet.hpp"
#include "mpmice/geometry/pieces.hpp"

namespace sluice::mpmice {
namespace {

// act(look, share): what chooses the cells of pieces in grid planes, outer faces theirs. Inner ones
// lie above, where both sides of one count alike; of particles that are solid in part by halves on
// both sides, as in the sums of cells (pieces.hpp).
template <int D, class Act>
void for_each_look(const OuterFaces<D>& faces, const FacetNodes<D>& nodes,
                   const std::array<double, D>& normal, bool outer, Act&& act) {
  if (outer) return act(normal, 1.0);
  std::array<double, D> look = normal;
  if (faces.weight.empty() || !in_grid_plane<D>(nodes)) {
    for (double& n : look) n = std::fabs(n);
    return act(look, 1.0);
  }
  act(look, 0.5);
  for (double& n : look) n = -n;
  act(look, 0.5);
}

}  // namespace

template <int D>
void CoveredSides<D>::begin(const CellBlocks<D>& cells, const PeriodicSides<D>& sides) {
  sides_ = sides;
  sums_.begin(cells, D);
}

template <int D>
void CoveredSides<D>::add_piece(const Cell<D>& cell, const std::array<double, D>& area) {
  for (std::size_t d = 0; d < D; ++d) {
    if (!sides_.periodic[d]) continue;
    const bool under = cell[d] < sides_.domain.lower[d], over = cell[d] >= sides_.domain.upper[d];
    if (!under && !over) continue;
    Cell<D> to = cell;
    to[d] = sides_.domain.upper[d];
    std::uint64_t& sum = sums_.lane(static_cast<int>(d))[sums_.cells().index_to_add(to)];
    sum += under ? to_sum(-area[d]) : to_sum(area[d]);
  }
}

template <int D>
void CoveredSides<D>::add(const OuterFaces<D>& faces, bool outer, When when) {
  const auto& x = when == When::start ? faces.start : faces.end;
  for (std::size_t i = 0; i < faces.size(); ++i)
    for (int t = 0; t < facets_of_face<D>; ++t) {
      const FacetNodes<D> nodes = facet_nodes<D>(x, i, t);
      const std::array<double, D> n = area_vector<D>(nodes, faces.face[i]);
      const auto cut = [&](const std::array<double, D>& look, double share) {
        cut_facet<D>(nodes, spans_towards<D>(nodes, look), look,
                     [&](const Cell<D>& cell, const Moments<D>& piece) {
                       std::array<double, D> area = n;
                       for (double& a : area) a *= share * faces.weight_of(i) * piece.s;
                       add_piece(cell, area);
                     });
      };
      for_each_look<D>(faces, nodes, n, outer, cut);
    }
}

template <int D>
void CoveredSides<D>::add_mean(const OuterFaces<D>& faces, bool outer) {
  for (std::size_t i = 0; i < faces.size(); ++i)
    for (int t = 0; t < facets_of_face<D>; ++t) {
      const MixedFacet<D> f(facet_nodes<D>(faces.start, i, t), facet_nodes<D>(faces.end, i, t),
                            faces.face[i]);
      for_each_cut<D>(f, [&](const std::array<Slots, D>& slots, const FacetNodes<D>& nodes) {
        const std::array<double, D> N = f.mean_area(slots);
        for_each_look<D>(
            faces, nodes, N, outer, [&](const std::array<double, D>& look, double share) {
              cut_facet<D>(nodes, f.spans, look, [&](const Cell<D>& cell, const Moments<D>& piece) {
                std::array<double, D> area = N;
                for (double& a : area) a *= share * faces.weight_of(i) * piece.s;
                add_piece(cell, area);
              });
            });
      });
    }
}

template <int D>
void CoveredSides<D>::finish() {
  for (int d = 0; d < D; ++d) {
    PeriodicSides<D> others = sides_;
    others.periodic[static_cast<std::size_t>(d)] = false;
    sums_.fold(others, d);
  }
}

template <int D>
void CoveredSides<D>::add_to(int d, std::uint64_t* lane) const {
  const auto a = static_cast<std::size_t>(d);
  if (!sides_.periodic[a]) return;
  const std::uint64_t* from = sums_.lane(d);
  const int high = sides_.domain.upper[a];
  for (std::size_t b = 1; b <= sums_.cells().block_count(); ++b) {
    CellBox<D> first = sums_.cells().cells(b);
    if (high < first.lower[a] || high >= first.upper[a]) continue;
    first.lower[a] = high;
    first.upper[a] = high + 1;
    for_each_cell_of<D>(first, [&](const Cell<D>& c) {
      const std::size_t i = sums_.cells().index(c);
      lane[i] += from[i];
    });
  }
}

template class CoveredSides<1>;
template class CoveredSides<2>;
template class CoveredSides<3>;

}  // namespace sluice::mpmice
