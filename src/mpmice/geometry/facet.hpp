// One facet: its D nodes, its area vector, the cells along an axis that it reaches.
#pragma once
#include <algorithm>
#include <cmath>

#include "mpmice/geometry/outer_faces.hpp"

namespace sluice::mpmice {

// Places of the nodes, [node][direction], cells.
template <int D>
using FacetNodes = std::array<std::array<double, D>, D>;

// Facet t of face i. The centre is the same to the bit from both sides of a face.
template <int D>
inline FacetNodes<D> facet_nodes(const typename OuterFaces<D>::Places& x, std::size_t i, int t) {
  FacetNodes<D> to;
  for (std::size_t d = 0; d < D; ++d) {
    if constexpr (D == 3) {
      const auto a = static_cast<std::size_t>(t);
      to[0][d] = ((x[0][d][i] + x[2][d][i]) + (x[1][d][i] + x[3][d][i])) * 0.25;
      to[1][d] = x[a][d][i];
      to[2][d] = x[(a + 1) % 4][d][i];
    } else {
      for (std::size_t k = 0; k < D; ++k) to[k][d] = x[k][d][i];
    }
  }
  return to;
}

// The cell in which the nodes begin along every direction; they are counted from it then. That is
// exact, so that a body moved by whole cells keeps its bits, and identities hold as well far from
// the origin: a facet nearly in a plane of the grid is cut at a vertex of full precision.
template <int D>
inline Cell<D> count_from_own_cell(FacetNodes<D>& x) {
  Cell<D> base;
  for (std::size_t d = 0; d < D; ++d) {
    double low = x[0][d];
    for (std::size_t k = 1; k < D; ++k) low = std::min(low, x[k][d]);
    low = std::floor(low);
    base[d] = static_cast<int>(low);
    for (std::size_t k = 0; k < D; ++k) x[k][d] -= low;
  }
  return base;
}

// The area vector, outward, in faces of a cell. In 1-D it knows the side alone.
template <int D>
inline std::array<double, D> area_vector(const FacetNodes<D>& p, int face) {
  if constexpr (D == 1) {
    return {(face & 1) != 0 ? 1.0 : -1.0};
  } else if constexpr (D == 2) {
    return {p[1][1] - p[0][1], -(p[1][0] - p[0][0])};
  } else {
    std::array<double, 3> e, f;
    for (std::size_t d = 0; d < 3; ++d) {
      e[d] = p[1][d] - p[0][d];
      f[d] = p[2][d] - p[0][d];
    }
    return {0.5 * (e[1] * f[2] - e[2] * f[1]), 0.5 * (e[2] * f[0] - e[0] * f[2]),
            0.5 * (e[0] * f[1] - e[1] * f[0])};
  }
}

// Cells low to high along an axis.
struct CellSpan {
  int low = 0, high = 0;
};

// Which the coordinates of the nodes span. Those of a facet in a grid plane: both beside it.
template <int D>
inline CellSpan span_along(const FacetNodes<D>& p, int d) {
  const auto a = static_cast<std::size_t>(d);
  double low = p[0][a], high = low;
  for (std::size_t k = 1; k < D; ++k) {
    low = std::min(low, p[k][a]);
    high = std::max(high, p[k][a]);
  }
  const int first = static_cast<int>(std::floor(low)), end = static_cast<int>(std::ceil(high));
  if (low == high) return {first == end ? first - 1 : first, first};
  return {first, end - 1};
}

// The same where the area vector is known: a facet in a grid plane belongs to the cell that its
// normal points to. So faces that are touched are covered, and forces act on the fluid's cell.
template <int D>
inline CellSpan span_along(const FacetNodes<D>& p, int d, double normal) {
  CellSpan span = span_along<D>(p, d);
  const auto a = static_cast<std::size_t>(d);
  bool flat = true;
  for (std::size_t k = 1; k < D; ++k) flat = flat && p[k][a] == p[0][a];
  if (flat) span.low = span.high = normal < 0 ? span.low : span.high;
  return span;
}

// Along all directions, for an area vector or one like it.
template <int D>
inline std::array<CellSpan, D> spans_towards(const FacetNodes<D>& p,
                                             const std::array<double, D>& look) {
  std::array<CellSpan, D> spans;
  for (int d = 0; d < D; ++d) {
    const auto a = static_cast<std::size_t>(d);
    spans[a] = span_along<D>(p, d, look[a]);
  }
  return spans;
}

// Adds moments of a facet's nodes to those of the corners of its face: a quarter of what the
// centre has goes to each corner.
template <int D>
inline void add_to_corners(int t, const std::array<double, D>& m,
                           std::array<double, corners_of_face<D>>& to) {
  if constexpr (D == 3) {
    for (double& share : to) share += 0.25 * m[0];
    to[static_cast<std::size_t>(t)] += m[1];
    to[static_cast<std::size_t>((t + 1) % 4)] += m[2];
  } else {
    for (std::size_t k = 0; k < D; ++k) to[k] += m[k];
  }
}

}  // namespace sluice::mpmice
