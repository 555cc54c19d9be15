// A facet that moves, as all its mixed shapes: each coordinate old or new (2^D shapes).
//
// Sums over shapes that share their cuts are taken before cutting: a coordinate needs an old and a
// new cut only where it moves and its cells along the step are two or more ("split"). For a cut,
// with the weights w of shapes for direction d (int over the step of the other coordinates' old or
// new parts: w = 1/3 if both are old or both new, else 1/6; in 2-D 1/2, in 1-D 1),
//
//   N_d = sum over the shapes of that cut of (w/2) n_d.
//
// n_d of a shape depends on the other coordinates alone.
#pragma once
#include "mpmice/geometry/cut.hpp"

namespace sluice::mpmice {

// Which slots of a coordinate a cut stands for: old (0), new (1) or both.
struct Slots {
  int first = 0, last = 0;
  int count() const { return last - first + 1; }
};

template <int D>
struct MixedFacet {
  std::array<FacetNodes<D>, 2> x;             // old, new
  std::array<std::array<double, D>, D> move;  // new - old, [direction][node]
  std::array<CellSpan, D> spans;              // cells of all shapes
  std::array<bool, D> is_split;
  // n_d of shapes, [d][slot of direction d + 1][slot of direction d + 2] (modulo 3); 2-D: [d][slot
  // of the other]; 1-D: the side.
  std::array<std::array<std::array<double, 2>, 2>, D> normal;

  MixedFacet(const FacetNodes<D>& from, const FacetNodes<D>& to, int face);

  // N_d, with the slots of every coordinate.
  std::array<double, D> mean_area(const std::array<Slots, D>& slots) const;
};

template <int D>
inline MixedFacet<D>::MixedFacet(const FacetNodes<D>& from, const FacetNodes<D>& to, int face)
    : x{from, to} {
  for (int d = 0; d < D; ++d) {
    const auto a = static_cast<std::size_t>(d);
    bool moves = false;
    for (std::size_t k = 0; k < D; ++k) {
      move[a][k] = to[k][a] - from[k][a];
      moves = moves || move[a][k] != 0;
    }
    spans[a] = span_along<D>(from, d);
    if (moves) {
      const CellSpan other = span_along<D>(to, d);
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
inline std::array<double, D> MixedFacet<D>::mean_area(const std::array<Slots, D>& slots) const {
  std::array<double, D> N;
  for (std::size_t d = 0; d < D; ++d) {
    double sum = 0;
    if constexpr (D == 1) {
      sum = normal[d][0][0];
    } else if constexpr (D == 2) {
      const Slots other = slots[1 - d];
      for (int u = other.first; u <= other.last; ++u)
        sum += 0.5 * normal[d][static_cast<std::size_t>(u)][0];
    } else {
      const Slots j = slots[(d + 1) % 3], k = slots[(d + 2) % 3];
      for (int u = j.first; u <= j.last; ++u)
        for (int v = k.first; v <= k.last; ++v)
          sum += (u == v ? 1.0 / 3 : 1.0 / 6) *
                 normal[d][static_cast<std::size_t>(u)][static_cast<std::size_t>(v)];
    }
    N[d] = 0.5 * slots[d].count() * sum;
  }
  return N;
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
