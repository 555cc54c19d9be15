// A facet cut at grid planes into pieces, one to a cell.
//
// A piece is a convex polygon (2-D: an edge, 1-D: the point) whose vertices carry their place and
// the weights l_1, l_2 of nodes 1, 2. Of a piece: its fraction s of the facet's area and the
// moments m_k = int l_k over it, sum_k m_k = s. They follow from the weights alone, with no
// division by areas: slivers are harmless, and what is cut adds up.
#pragma once
#include <utility>

#include "mpmice/geometry/facet.hpp"

namespace sluice::mpmice {

template <int D>
struct Vertex {
  std::array<double, D> x;
  std::array<double, D> l;  // l[0] is not used
};

template <int D>
struct Polygon {
  // A cut gives at most 3/2 of the vertices, even where round-off lets the plane be crossed more
  // than twice: 3 4 6 9 13 19 28.
  static constexpr std::size_t most = D == 3 ? 28 : D;
  std::size_t n;
  std::array<Vertex<D>, most> v;

  void push(const Vertex<D>& vertex) { v[n++] = vertex; }
};

template <int D>
struct Moments {
  double s;
  std::array<double, D> m;
};

template <int D>
inline Moments<D> moments_of(const Polygon<D>& p) {
  Moments<D> to{1, {}};
  if constexpr (D == 1) {
    to.m[0] = 1;
  } else if constexpr (D == 2) {
    to.s = p.v[1].l[1] - p.v[0].l[1];
    to.m[1] = to.s * (0.5 * (p.v[1].l[1] + p.v[0].l[1]));
    to.m[0] = to.s - to.m[1];
  } else {
    // A fan of triangles in the plane of l_1, l_2, where the facet has the area 1/2.
    double s = 0, m1 = 0, m2 = 0;
    const auto& o = p.v[0].l;
    for (std::size_t i = 1; i + 1 < p.n; ++i) {
      const auto &a = p.v[i].l, &b = p.v[i + 1].l;
      const double part = (a[1] - o[1]) * (b[2] - o[2]) - (a[2] - o[2]) * (b[1] - o[1]);
      s += part;
      m1 += part * (o[1] + a[1] + b[1]);
      m2 += part * (o[2] + a[2] + b[2]);
    }
    to.s = s;
    to.m[1] = m1 * (1.0 / 3);
    to.m[2] = m2 * (1.0 / 3);
    to.m[0] = s - to.m[1] - to.m[2];
  }
  return to;
}

// Where the edge p q meets x_d = plane, from the end with the smaller coordinate: the same bits
// whichever way the edge is walked.
template <int D>
inline Vertex<D> meeting_point(const Vertex<D>& p, const Vertex<D>& q, int d, double plane) {
  const auto a = static_cast<std::size_t>(d);
  const bool rising = p.x[a] < q.x[a];
  const Vertex<D>&low = rising ? p : q, &high = rising ? q : p;
  const double t = (plane - low.x[a]) / (high.x[a] - low.x[a]);
  Vertex<D> to;
  for (std::size_t k = 0; k < D; ++k) {
    // No farther than the ends, that no piece leaves the cells of its facet.
    const double x = low.x[k] + t * (high.x[k] - low.x[k]);
    to.x[k] = std::clamp(x, std::min(low.x[k], high.x[k]), std::max(low.x[k], high.x[k]));
    to.l[k] = low.l[k] + t * (high.l[k] - low.l[k]);
  }
  to.x[a] = plane;
  return to;
}

// What lies at x_d < plane goes to `low`, the rest to `high`.
template <int D>
inline void split(const Polygon<D>& p, int d, double plane, Polygon<D>& low, Polygon<D>& high) {
  const auto a = static_cast<std::size_t>(d);
  low.n = high.n = 0;
  for (std::size_t i = 0; i < p.n; ++i) {
    const Vertex<D>& here = p.v[i];
    const bool below = here.x[a] < plane;
    (below ? low : high).push(here);
    if (D == 2 && i + 1 == p.n) break;  // an edge is open
    const Vertex<D>& next = p.v[i + 1 < p.n ? i + 1 : 0];
    if ((next.x[a] < plane) == below) continue;
    const Vertex<D> cut = meeting_point<D>(here, next, d, plane);
    low.push(cut);
    high.push(cut);
  }
}

// act(cell, polygon) for the pieces of a polygon, cut along directions d, ..., D - 1. `spans`:
// cells of the whole facet; no cut along a direction where that is one cell.
template <int d, int D, class Act>
void cut_along(const Polygon<D>& p, const std::array<CellSpan, D>& spans,
               const std::array<double, D>& normal, Cell<D>& cell, Act&& act) {
  if constexpr (d == D) {
    act(std::as_const(cell), p);
  } else {
    constexpr std::size_t a = d;
    const CellSpan span = spans[a];
    double low = p.v[0].x[a], high = low;
    if (span.low != span.high)
      for (std::size_t i = 1; i < p.n; ++i) {
        low = std::min(low, p.v[i].x[a]);
        high = std::max(high, p.v[i].x[a]);
      }
    if (low == high) {  // one cell, or in a plane x_d = const
      const int at = static_cast<int>(std::floor(low));
      const bool on_plane = at == low;
      cell[a] = std::clamp(on_plane && normal[a] < 0 ? at - 1 : at, span.low, span.high);
      cut_along<d + 1, D>(p, spans, normal, cell, act);
      return;
    }
    const int last = static_cast<int>(std::ceil(high)) - 1;
    cell[a] = static_cast<int>(std::floor(low));
    if (cell[a] == last) {
      cut_along<d + 1, D>(p, spans, normal, cell, act);
      return;
    }
    if constexpr (D > 1) {
      Polygon<D> slab, rest[2];
      const Polygon<D>* from = &p;
      int i = cell[a];
      for (int turn = 0; i < last; ++i, turn ^= 1) {
        split<D>(*from, d, i + 1, slab, rest[turn]);
        cell[a] = i;
        if (slab.n > 0) cut_along<d + 1, D>(slab, spans, normal, cell, act);
        from = &rest[turn];
      }
      cell[a] = last;
      if (from->n > 0) cut_along<d + 1, D>(*from, spans, normal, cell, act);
    }
  }
}

// act(cell, moments) for the pieces of a facet; `normal`: its area vector, or one like it, which
// chooses the cells of pieces in grid planes.
template <int D, class Act>
void cut_facet(const FacetNodes<D>& nodes, const std::array<CellSpan, D>& spans,
               const std::array<double, D>& normal, Act&& act) {
  Cell<D> cell;
  bool whole = true;
  for (std::size_t d = 0; d < D; ++d) {
    cell[d] = spans[d].low;
    whole = whole && spans[d].low == spans[d].high;
  }
  if (whole) {
    Moments<D> all;
    all.s = 1;
    all.m.fill(1.0 / D);
    act(std::as_const(cell), all);
    return;
  }
  Polygon<D> p;
  p.n = D;
  for (std::size_t k = 0; k < D; ++k) {
    p.v[k].x = nodes[k];
    p.v[k].l.fill(0);
    p.v[k].l[k] = 1;
  }
  cut_along<0, D>(p, spans, normal, cell, [&](const Cell<D>& at, const Polygon<D>& piece) {
    act(at, moments_of<D>(piece));
  });
}

}  // namespace sluice::mpmice
