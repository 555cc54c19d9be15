#include "mpm/transfer/corners.hpp"

#include <algorithm>
#include <cmath>

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
      double* to = edges[a][e];
      std::fill_n(to, n, 0.0);
      for (int k = 0; k < D; ++k) {
        const std::size_t i = grid.active[a];
        const std::size_t j = grid.active[k];
        const std::size_t c = grid.active[e];
        const double scale = grid.axes[j].spacing * grid.axes[i].inverse;
        const double *F = shape.F[3 * i + j] + at, *R = shape.edges[3 * j + c] + at;
        for (int q = 0; q < n; ++q) to[q] += (F[q] * scale) * R[q];
      }
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
void invert(const Edges<D>& E, int n, Edges<D>& to) {
  for (int q = 0; q < n; ++q) {
    if constexpr (D == 1) {
      to[0][0][q] = 1 / E[0][0][q];
    } else if constexpr (D == 2) {
      const double inverse = 1 / (E[0][0][q] * E[1][1][q] - E[0][1][q] * E[1][0][q]);
      to[0][0][q] = E[1][1][q] * inverse;
      to[0][1][q] = -E[0][1][q] * inverse;
      to[1][0][q] = -E[1][0][q] * inverse;
      to[1][1][q] = E[0][0][q] * inverse;
    } else {
      const auto cofactor = [&](int r, int c) {
        const int r1 = (r + 1) % 3, r2 = (r + 2) % 3, c1 = (c + 1) % 3, c2 = (c + 2) % 3;
        return E[r1][c1][q] * E[r2][c2][q] - E[r1][c2][q] * E[r2][c1][q];
      };
      const double x = cofactor(0, 0), y = cofactor(0, 1), z = cofactor(0, 2);
      const double inverse = 1 / (E[0][0][q] * x + E[0][1][q] * y + E[0][2][q] * z);
      to[0][0][q] = x * inverse;
      to[1][0][q] = y * inverse;
      to[2][0][q] = z * inverse;
      for (int r = 1; r < 3; ++r)
        for (int c = 0; c < 3; ++c) to[c][r][q] = cofactor(r, c) * inverse;
    }
  }
}

// Ways to the corners: combinations of edges.
template <int D, bool Tetrahedron>
void spread_ways(const Edges<D>& E, int n, Corners<D, Tetrahedron>& to) {
  for (int a = 0; a < D; ++a)
    for (int c = 0; c < to.count; ++c) {
      double* way = to.way[c][a];
      for (int q = 0; q < n; ++q) {
        if constexpr (Tetrahedron) {
          const double to_first = -0.25 * (E[a][0][q] + E[a][1][q] + E[a][2][q]);
          way[q] = c == 0 ? to_first : to_first + E[a][c - 1][q];
        } else {
          double edge = c & 1 ? E[a][0][q] : -E[a][0][q];
          for (int e = 1; e < D; ++e) edge += c >> e & 1 ? E[a][e][q] : -E[a][e][q];
          way[q] = 0.5 * edge;
        }
      }
    }
}

// Slopes of the corners: combinations of rows of the inverse.
template <int D, bool Tetrahedron>
void spread_slopes(const TransferGrid& grid, const Edges<D>& inverse, int n,
                   Corners<D, Tetrahedron>& to) {
  constexpr double factor = Tetrahedron ? 1.0 : D == 3 ? 0.25 : D == 2 ? 0.5 : 1.0;
  for (int a = 0; a < D; ++a) {
    const double scale = factor * grid.axes[grid.active[a]].inverse;
    for (int c = 0; c < to.count; ++c) {
      double* slope = to.slope[c][a];
      for (int q = 0; q < n; ++q) {
        if constexpr (Tetrahedron) {
          slope[q] = c == 0 ? -(inverse[0][a][q] + inverse[1][a][q] + inverse[2][a][q]) * scale
                            : inverse[c - 1][a][q] * scale;
        } else {
          double row = c & 1 ? inverse[0][a][q] : -inverse[0][a][q];
          for (int e = 1; e < D; ++e) row += c >> e & 1 ? inverse[e][a][q] : -inverse[e][a][q];
          slope[q] = row * scale;
        }
      }
    }
  }
}

// Of corners that particles carry: from their middle, which is the place of the particle.
template <int D>
void carried_ways(const TransferGrid& grid, const ParticleShape& shape, int at, int n,
                  Slopes slopes, Corners<D, false>& to) {
  double inverse[D];
  for (int a = 0; a < D; ++a) inverse[a] = grid.axes[grid.active[a]].inverse;
  for (int q = 0; q < n; ++q) {
    CornerVolume<D> v;
    read_carried<D>(shape.corners, grid.active, at + q, v.x);
    if (slopes == Slopes::wanted)
      v.find();
    else
      v.find_middle();
    for (int c = 0; c < to.count; ++c)
      for (int a = 0; a < D; ++a) to.way[c][a][q] = v.x[c][a] * inverse[a];
    if (slopes == Slopes::unused) continue;
    const double share = 1 / v.volume;
    for (int c = 0; c < to.count; ++c)
      for (int a = 0; a < D; ++a) to.slope[c][a][q] = v.b[c][a] * share;
  }
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
  bool sound = true;
  for (int at = begin; at < end; at += chunk_size) {
    const int n = std::min(chunk_size, end - at);
    find_ways(grid, shape, at, n, Slopes::wanted, corners);
    for (int c = 0; c < corners.count; ++c)
      for (int q = 0; q < n; ++q) {
        double slopes = 0;
        for (int a = 0; a < D; ++a) {
          const double way = std::fabs(corners.way[c][a][q]);
          sound &= way == way;
          reach.extent = std::max(reach.extent, way);
          slopes += std::fabs(corners.slope[c][a][q]);
        }
        sound &= slopes == slopes;
        reach.slope = std::max(reach.slope, slopes);
      }
  }
  // What is no number rejects the step.
  if (!sound) reach.extent = std::nan("");
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
    const Axis& axis = grid.axes[d];
    const double* places = x[d] + at;
    for (int c = 0; c < to.count; ++c) {
      const double* way = to.way[c][a];
      double* s = to.s[c][a];
      int* first = to.first[c][a];
      const double* corner = shape.corners[3 * c + d];
      for (int q = 0; q < n; ++q) {
        // Corners of neighbours that have the same bits have the same weights, to the bit.
        const double u =
            corner != nullptr ? axis.place(corner[at + q]) : axis.place(places[q]) + way[q];
        const double middle = nearest_middle(axis, u);
        s[q] = u - middle;
        first[q] = static_cast<int>(middle - 0.5 + axis.first);
      }
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
