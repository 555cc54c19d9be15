#include "mpm/transfer/corners.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "framework/base/largest.hpp"

namespace sluice::mpm {
namespace {

template <int D>
using Edges = double[D][D][chunk_size];  // component, edge; in cells

// E_ae in cells: sum_k F_ak (h_k/h_a) R0_ke over the active directions.
template <int D>
void find_edges(const TransferGrid& grid, const ParticleShape& shape, int at, int n,
                Edges<D>& edges) {
  for (int a = 0; a < D; ++a)
    for (int e = 0; e < D; ++e) {
      std::array<const double*, D> F, R;
      std::array<double, D> scale;
      for (std::size_t k = 0; k < D; ++k) {
        const std::size_t i = grid.active[a], j = grid.active[k], c = grid.active[e];
        scale[k] = grid.axes[j].spacing * grid.axes[i].inverse;
        F[k] = shape.F[3 * i + j] + at;
        R[k] = shape.edges[3 * j + c] + at;
      }
      for_eights(0, static_cast<std::size_t>(n), [&](auto q) {
        auto sum = (q(F[0]) * scale[0]) * q(R[0]);
        for (std::size_t k = 1; k < D; ++k) sum += (q(F[k]) * scale[k]) * q(R[k]);
        q.put(sum, edges[a][e]);
      });
    }
}

// Cuts the half diagonals d_c = E s_c/2 of one particle to a length; the edges are the least
// squares of the diagonals: the vectors s_c are orthogonal.
template <int D>
void cut_edges(Edges<D>& edges, int q, double limit) {
  constexpr int count = D == 3 ? 4 : D;  // diagonals, up to their sign
  // Signs along the edges: of three (+++), (-++), (+-+), (++-); of two (++), (-+).
  const auto sign = [](int c, int e) { return c > 0 && c - 1 == e ? -1.0 : 1.0; };
  double d[count][D], longest = 0;
  for (int c = 0; c < count; ++c) {
    double square = 0;
    for (int a = 0; a < D; ++a) {
      double sum = sign(c, 0) * edges[a][0][q];
      for (int e = 1; e < D; ++e) sum += sign(c, e) * edges[a][e][q];
      d[c][a] = 0.5 * sum;
      square += d[c][a] * d[c][a];
    }
    const double length = std::sqrt(square);
    longest = std::max(longest, length);
    if (length > limit)
      for (double& component : d[c]) component *= limit / length;
  }
  if (!(longest > limit)) return;
  for (int a = 0; a < D; ++a) {
    if constexpr (D == 1) {
      edges[a][0][q] = 2 * d[0][a];
    } else if constexpr (D == 2) {
      edges[a][0][q] = d[0][a] - d[1][a];
      edges[a][1][q] = d[0][a] + d[1][a];
    } else {
      edges[a][0][q] = 0.5 * ((d[0][a] - d[1][a]) + (d[2][a] + d[3][a]));
      edges[a][1][q] = 0.5 * ((d[0][a] + d[1][a]) + (d[3][a] - d[2][a]));
      edges[a][2][q] = 0.5 * ((d[0][a] + d[1][a]) + (d[2][a] - d[3][a]));
    }
  }
}

// Inverse of E, [edge][component], 1/cells.
template <int D>
void invert(const Edges<D>& edges, int n, Edges<D>& to) {
  for_eights(0, static_cast<std::size_t>(n), [&](auto q) {
    using T = typename decltype(q)::Number;
    T E[D][D];
    for (int a = 0; a < D; ++a)
      for (int e = 0; e < D; ++e) E[a][e] = q(edges[a][e]);
    if constexpr (D == 1) {
      q.put(1.0 / E[0][0], to[0][0]);
    } else if constexpr (D == 2) {
      const T inverse = 1.0 / (E[0][0] * E[1][1] - E[0][1] * E[1][0]);
      q.put(E[1][1] * inverse, to[0][0]);
      q.put(-E[0][1] * inverse, to[0][1]);
      q.put(-E[1][0] * inverse, to[1][0]);
      q.put(E[0][0] * inverse, to[1][1]);
    } else {
      const auto cofactor = [&](int r, int c) {
        const int r1 = (r + 1) % 3, r2 = (r + 2) % 3, c1 = (c + 1) % 3, c2 = (c + 2) % 3;
        return E[r1][c1] * E[r2][c2] - E[r1][c2] * E[r2][c1];
      };
      const T x = cofactor(0, 0), y = cofactor(0, 1), z = cofactor(0, 2);
      const T inverse = 1.0 / (E[0][0] * x + E[0][1] * y + E[0][2] * z);
      q.put(x * inverse, to[0][0]);
      q.put(y * inverse, to[1][0]);
      q.put(z * inverse, to[2][0]);
      for (int r = 1; r < 3; ++r)
        for (int c = 0; c < 3; ++c) q.put(cofactor(r, c) * inverse, to[c][r]);
    }
  });
}

// Ways to the corners: combinations of edges.
template <int D, bool Tetrahedron>
void spread_ways(const Edges<D>& edges, int n, Corners<D, Tetrahedron>& to) {
  for_eights(0, static_cast<std::size_t>(n), [&](auto q) {
    using T = typename decltype(q)::Number;
    for (int a = 0; a < D; ++a) {
      T E[D];
      for (int e = 0; e < D; ++e) E[e] = q(edges[a][e]);
      for (int c = 0; c < to.count; ++c) {
        if constexpr (Tetrahedron) {
          const T to_first = -0.25 * (E[0] + E[1] + E[2]);
          q.put(c == 0 ? to_first : to_first + E[c - 1], to.way[c][a]);
        } else {
          T edge = c & 1 ? E[0] : -E[0];
          for (int e = 1; e < D; ++e) edge += c >> e & 1 ? E[e] : -E[e];
          q.put(0.5 * edge, to.way[c][a]);
        }
      }
    }
  });
}

// Slopes of the corners: combinations of rows of the inverse.
template <int D, bool Tetrahedron>
void spread_slopes(const TransferGrid& grid, const Edges<D>& inverse, int n,
                   Corners<D, Tetrahedron>& to) {
  constexpr double factor = Tetrahedron ? 1.0 : D == 3 ? 0.25 : D == 2 ? 0.5 : 1.0;
  for_eights(0, static_cast<std::size_t>(n), [&](auto q) {
    using T = typename decltype(q)::Number;
    for (int a = 0; a < D; ++a) {
      const double scale = factor * grid.axes[grid.active[a]].inverse;
      T row[D];
      for (int e = 0; e < D; ++e) row[e] = q(inverse[e][a]);
      for (int c = 0; c < to.count; ++c) {
        if constexpr (Tetrahedron) {
          q.put(c == 0 ? -(row[0] + row[1] + row[2]) * scale : row[c - 1] * scale, to.slope[c][a]);
        } else {
          T sum = c & 1 ? row[0] : -row[0];
          for (int e = 1; e < D; ++e) sum += c >> e & 1 ? row[e] : -row[e];
          q.put(sum * scale, to.slope[c][a]);
        }
      }
    }
  });
}

// Of corners that particles carry: from their middle, which is the place of the particle.
template <int D>
void carried_ways(const TransferGrid& grid, const ParticleShape& shape, int at, int n,
                  Slopes slopes, Corners<D, false>& to) {
  double inverse[D];
  for (int a = 0; a < D; ++a) inverse[a] = grid.axes[grid.active[a]].inverse;
  for_eights(0, static_cast<std::size_t>(n), [&](auto q) {
    CornerVolume<D, typename decltype(q)::Number> v;
    read_carried<D>(shape.corners, grid.active, q.behind(static_cast<std::size_t>(at)), v.x);
    if (slopes == Slopes::wanted)
      v.find();
    else
      v.find_middle();
    for (int c = 0; c < to.count; ++c)
      for (int a = 0; a < D; ++a) q.put(v.x[c][a] * inverse[a], to.way[c][a]);
    if (slopes == Slopes::unused) return;
    const auto share = 1.0 / v.volume;
    for (int c = 0; c < to.count; ++c)
      for (int a = 0; a < D; ++a) q.put(v.b[c][a] * share, to.slope[c][a]);
  });
}

template <int D, bool Tetrahedron>
void find_ways(const TransferGrid& grid, const ParticleShape& shape, int at, int n, Slopes slopes,
               Corners<D, Tetrahedron>& to) {
  if constexpr (!Tetrahedron)
    if (shape.corners[0] != nullptr) return carried_ways(grid, shape, at, n, slopes, to);
  alignas(64) Edges<D> edges, inverse;
  find_edges<D>(grid, shape, at, n, edges);
  if (!Tetrahedron && grid.corner_limit < 1e300)
    for (int q = 0; q < n; ++q) cut_edges<D>(edges, q, grid.corner_limit);
  spread_ways(edges, n, to);
  if (slopes == Slopes::unused) return;
  invert<D>(edges, n, inverse);
  spread_slopes(grid, inverse, n, to);
}

template <int D, bool Tetrahedron>
CornerReach reach_of_corners(const TransferGrid& grid, const ParticleShape& shape, int begin,
                             int end) {
  static thread_local Corners<D, Tetrahedron> corners;
  CornerReach reach;
  for (int at = begin; at < end; at += chunk_size) {
    const int n = std::min(chunk_size, end - at);
    find_ways(grid, shape, at, n, Slopes::wanted, corners);
    const auto most = [&](double from, const auto& of) {
      return largest(0, static_cast<std::size_t>(n), from, of);
    };
    for (int c = 0; c < corners.count; ++c) {
      const auto& way = corners.way[c];
      const auto& slope = corners.slope[c];
      for (int a = 0; a < D; ++a)
        keep_larger(reach.extent, most(0, [&](auto of) { return magnitude(of(way[a])); }));
      keep_larger(reach.slope, most(0, [&](auto of) {
                    auto sum = magnitude(of(slope[0]));
                    for (int a = 1; a < D; ++a) sum += magnitude(of(slope[a]));
                    return sum;
                  }));
    }
  }
  // What is no number rejects the step.
  if (!(reach.slope <= std::numeric_limits<double>::max())) reach.extent = std::nan("");
  return reach;
}

}  // namespace

template <int D, bool Tetrahedron>
void find_corners(const TransferGrid& grid, const std::array<const double*, 3>& x,
                  const ParticleShape& shape, int at, int n, Slopes slopes,
                  Corners<D, Tetrahedron>& to) {
  find_ways(grid, shape, at, n, slopes, to);
  for (int a = 0; a < D; ++a) {
    const std::size_t d = grid.active[a];
    const Axis axis = grid.axes[d];
    const double* places = x[d] + at;
    for (int c = 0; c < to.count; ++c) {
      const double* way = to.way[c][a];
      double* s = to.s[c][a];
      int* first = to.first[c][a];
      const double* corner = shape.corners[3 * c + d];
      for_eights(0, static_cast<std::size_t>(n), [&](auto q) {
        // Corners of neighbours that have the same bits have the same weights, to the bit.
        const auto u =
            corner != nullptr ? axis.place(q(corner + at)) : axis.place(q(places)) + q(way);
        const auto middle = nearest_middle(axis, u);
        q.put(u - middle, s);
        q.put(middle - 0.5 + axis.first, first);
      });
    }
  }
}

template void find_corners(const TransferGrid&, const std::array<const double*, 3>&,
                           const ParticleShape&, int, int, Slopes, Corners<1, false>&);
template void find_corners(const TransferGrid&, const std::array<const double*, 3>&,
                           const ParticleShape&, int, int, Slopes, Corners<2, false>&);
template void find_corners(const TransferGrid&, const std::array<const double*, 3>&,
                           const ParticleShape&, int, int, Slopes, Corners<3, false>&);
template void find_corners(const TransferGrid&, const std::array<const double*, 3>&,
                           const ParticleShape&, int, int, Slopes, Corners<3, true>&);

CornerReach corner_reach(Basis basis, const TransferGrid& grid, const ParticleShape& shape,
                         int begin, int end) {
  if (basis == Basis::cpti) return reach_of_corners<3, true>(grid, shape, begin, end);
  if (grid.count == 3) return reach_of_corners<3, false>(grid, shape, begin, end);
  if (grid.count == 2) return reach_of_corners<2, false>(grid, shape, begin, end);
  return reach_of_corners<1, false>(grid, shape, begin, end);
}

}  // namespace sluice::mpm
