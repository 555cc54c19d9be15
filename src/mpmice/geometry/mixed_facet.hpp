// A facet that moves, as all its mixed shapes: each coordinate old or new (2^D shapes).
//
// Sums over shapes that share their cuts are taken before cutting: a coordinate needs an old and a
// new cut only where it moves and its cells along the step are two or more ("split"). The time mean
// of what is linear in every coordinate while all of them move together has the weights
//
//   W = int t^k (1 - t)^(D - k) dt,  k of the D coordinates new:  3-D 1/4 (all old, all new), 1/12;
//   1-D 1/2;  2-D 1/4 each (any with the sums below will do),
//
// and what the motion along d alone sweeps, while the others stand at their old or new places,
// those of the others alone, w = W(old along d) + W(new along d): 3-D 1/3 (both old, both new),
// 1/6;  2-D 1/2;  1-D 1. For a cut,
//
//   N_d = sum over the shapes of that cut of W n_d,  P_d = sum over their other coordinates of
//   w n_d.
//
// n_d of a shape depends on the other coordinates alone. Places are counted from `base`, the lowest
// cell of the facet at both ends (count_from_own_cell).
#pragma once
#include "mpmice/geometry/cut.hpp"

namespace sluice::mpmice {

// Which slots of a coordinate a cut stands for: old (0), new (1) or both.
struct Slots {
  int first = 0, last = 0;
  int count() const { return last - first + 1; }
};

// W of a shape with so many new coordinates.
template <int D>
constexpr double weight_of_shape(int news) {
  if constexpr (D == 3) return news == 0 || news == 3 ? 1.0 / 4 : 1.0 / 12;
  return D == 2 ? 1.0 / 4 : 1.0 / 2;
}

template <int D>
struct MixedFacet {
  Cell<D> base;
  std::array<FacetNodes<D>, 2> x;             // old, new; from base
  std::array<std::array<double, D>, D> move;  // new - old, [direction][node]
  std::array<CellSpan, D> spans;              // cells of all shapes
  std::array<bool, D> is_split;
  // n_d of shapes, [d][slot of direction d + 1][slot of direction d + 2] (modulo 3); 2-D: [d][slot
  // of the other]; 1-D: the side.
  std::array<std::array<std::array<double, 2>, 2>, D> normal;

  MixedFacet(const FacetNodes<D>& from, const FacetNodes<D>& to, int face);
};

// Area vectors of a cut: N_d, and its parts of the old and new places along d; P_d.
template <int D>
struct MeanArea {
  std::array<double, D> N{}, P{};
  std::array<std::array<double, 2>, D> at{};

  MeanArea(const MixedFacet<D>& f, const std::array<Slots, D>& slots);
  void scale(double by) {
    for (std::size_t d = 0; d < D; ++d) {
      N[d] *= by;
      P[d] *= by;
      for (double& part : at[d]) part *= by;
    }
  }
};

template <int D>
inline MixedFacet<D>::MixedFacet(const FacetNodes<D>& from, const FacetNodes<D>& to, int face)
    : x{from, to} {
  for (std::size_t d = 0; d < D; ++d) {
    double low = from[0][d];
    for (std::size_t k = 0; k < D; ++k) low = std::min({low, from[k][d], to[k][d]});
    low = std::floor(low);
    base[d] = static_cast<int>(low);
    for (FacetNodes<D>& nodes : x)
      for (std::size_t k = 0; k < D; ++k) nodes[k][d] -= low;
  }
  for (int d = 0; d < D; ++d) {
    const auto a = static_cast<std::size_t>(d);
    bool moves = false;
    for (std::size_t k = 0; k < D; ++k) {
      move[a][k] = to[k][a] - from[k][a];
      moves = moves || move[a][k] != 0;
    }
    spans[a] = span_along<D>(x[0], d);
    if (moves) {
      const CellSpan other = span_along<D>(x[1], d);
      spans[a] = {std::min(spans[a].low, other.low), std::max(spans[a].high, other.high)};
    }
    is_split[a] = moves && spans[a].low != spans[a].high;
  }
  const auto edge = [&](std::size_t node, std::size_t d, std::size_t slot) {
    return x[slot][node][d] - x[slot][0][d];
  };
  for (std::size_t d = 0; d < D; ++d)
    for (std::size_t u = 0; u < 2; ++u)
      for (std::size_t v = 0; v < 2; ++v) {
        if constexpr (D == 1) {
          normal[d][u][v] = (face & 1) != 0 ? 1 : -1;
        } else if constexpr (D == 2) {
          normal[d][u][v] = d == 0 ? edge(1, 1, u) : -edge(1, 0, u);
        } else {
          const std::size_t j = (d + 1) % 3, k = (d + 2) % 3;
          normal[d][u][v] = 0.5 * (edge(1, j, u) * edge(2, k, v) - edge(1, k, v) * edge(2, j, u));
        }
      }
}

template <int D>
inline MeanArea<D>::MeanArea(const MixedFacet<D>& f, const std::array<Slots, D>& slots) {
  for (std::size_t d = 0; d < D; ++d) {
    const auto include = [&](double n, int news) {
      for (int own = slots[d].first; own <= slots[d].last; ++own)
        at[d][static_cast<std::size_t>(own)] += weight_of_shape<D>(news + own) * n;
      P[d] += (weight_of_shape<D>(news) + weight_of_shape<D>(news + 1)) * n;
    };
    if constexpr (D == 1) {
      include(f.normal[d][0][0], 0);
    } else if constexpr (D == 2) {
      const Slots other = slots[1 - d];
      for (int u = other.first; u <= other.last; ++u)
        include(f.normal[d][static_cast<std::size_t>(u)][0], u);
    } else {
      const Slots j = slots[(d + 1) % 3], k = slots[(d + 2) % 3];
      for (int u = j.first; u <= j.last; ++u)
        for (int v = k.first; v <= k.last; ++v)
          include(f.normal[d][static_cast<std::size_t>(u)][static_cast<std::size_t>(v)], u + v);
    }
    N[d] = at[d][0] + at[d][1];
  }
}

// act(slots, nodes) for every cut.
template <int D, class Act>
inline void for_each_cut(const MixedFacet<D>& f, Act&& act) {
  for (unsigned bits = 0; bits < (1u << D); ++bits) {
    std::array<Slots, D> slots;
    FacetNodes<D> nodes;
    bool wanted = true;
    for (std::size_t d = 0; d < D; ++d) {
      const int slot = static_cast<int>(bits >> d) & 1;
      wanted = wanted && (f.is_split[d] || slot == 0);
      slots[d] = f.is_split[d] ? Slots{slot, slot} : Slots{0, 1};
      for (std::size_t k = 0; k < D; ++k) nodes[k][d] = f.x[static_cast<std::size_t>(slot)][k][d];
    }
    if (wanted) act(slots, nodes);
  }
}

}  // namespace sluice::mpmice
