// Particles that carry their corners: volume, and how it follows the corners.
//
// A particle has 2^D corners x_k in D directions; corner k is on the high side of edge a where bit
// a of k is set. Corners move with the grid, so that neighbours that share one go on sharing it.
//
//   S_i = 2^-D sum_k N_i(x_k),  V grad S_i = sum_k b_k N_i(x_k),  b_k = dV/dx_k
//
// V is the length, the area of the quadrilateral, or the volume of the hexahedron whose faces
// a b c d are four triangles around m = (a + b + c + d)/4, alike from both sides:
//
//   b_k = sum over its faces of (c - a) x (d - b)/24 + (x_prev - x_next) x (x_k - m)/6
//
// (in 2-D the trapezoid rule on edges: b_k = R(x_next - x_prev)/2, R(a, b) = (b, -a)). So
// sum b_k = 0, sum b_k (x) x_k = V 1, and what faces between neighbours give cancels: with one
// pressure in a body sum_p V_p p grad S_ip is that of its surface alone
// (docs/theory/mpmice_coupling.md). Mirror images have mirrored bits.
#pragma once
#include <array>
#include <cstddef>

#include "framework/base/eight.hpp"

namespace sluice::solids {

// Corners lie at most so far from the middle of their particle along a direction, cells: windows of
// nodes and layers of ghosts rest on it. Farther ones end the run.
inline constexpr double farthest_corner = 1.5;

// A sum over corners, of any unit, whose mirror image has the mirrored bits.
template <int N, class T>
inline T corner_sum(const T (&v)[N]) {
  if constexpr (N == 1) {
    return v[0];
  } else if constexpr (N == 2) {
    return v[0] + v[1];
  } else if constexpr (N == 4) {
    return (v[0] + v[1]) + (v[2] + v[3]);
  } else {
    return ((v[0] + v[1]) + (v[2] + v[3])) + ((v[4] + v[5]) + (v[6] + v[7]));
  }
}

// Of one particle (T: double) or of eight (T: Eight), with the same bits, in D directions: m,
// volume m^D, b m^(D-1).
template <int D, class T = double>
struct CornerVolume {
  static constexpr int count = 1 << D;
  T x[count][D];  // in: corners; out: from their middle
  T middle[D];
  T volume;
  T b[count][D];

  // Everything else, from x.
  void find() {
    find_middle();
    if constexpr (D == 1) {
      volume = x[1][0] - x[0][0];
      b[0][0] = T{} - 1.0;
      b[1][0] = T{} + 1.0;
    } else if constexpr (D == 2) {
      find_area();
    } else {
      for (auto& of : b) of[0] = of[1] = of[2] = T{};
      for (int a = 0; a < 3; ++a) {
        add_face(a, 0, -1.0);
        add_face(a, 1, 1.0);
      }
      T term[count];
      for (int k = 0; k < count; ++k)
        term[k] = (b[k][0] * x[k][0] + b[k][1] * x[k][1]) + b[k][2] * x[k][2];
      volume = corner_sum(term) * (1.0 / 3);
    }
  }

  // Corners are multiples of one unit (Axis::unit): from a corner on all of this is exact, so that
  // a particle that moves as a whole keeps its volume to the bit.
  void find_middle() {
    for (int a = 0; a < D; ++a) {
      T way[count];
      const T origin = x[0][a];
      for (int k = 0; k < count; ++k) way[k] = x[k][a] - origin;
      const T mean = corner_sum(way) * (1.0 / count);
      for (int k = 0; k < count; ++k) x[k][a] = way[k] - mean;
      middle[a] = origin + mean;
    }
  }

 private:
  void find_area() {
    const T up[2] = {x[3][0] - x[0][0], x[3][1] - x[0][1]};
    const T down[2] = {x[2][0] - x[1][0], x[2][1] - x[1][1]};
    volume = 0.5 * (up[0] * down[1] - up[1] * down[0]);
    b[0][0] = -0.5 * down[1];
    b[0][1] = 0.5 * down[0];
    b[1][0] = 0.5 * up[1];
    b[1][1] = -0.5 * up[0];
    for (int a = 0; a < 2; ++a) {
      b[2][a] = -b[1][a];
      b[3][a] = -b[0][a];
    }
  }

  static void add_cross(double s, const T (&p)[3], const T (&q)[3], T (&to)[3]) {
    to[0] += s * (p[1] * q[2] - p[2] * q[1]);
    to[1] += s * (p[2] * q[0] - p[0] * q[2]);
    to[2] += s * (p[0] * q[1] - p[1] * q[0]);
  }

  // The face on one side of edge axis a; sign: +1 on the high side.
  void add_face(int a, int side, double sign) {
    const int e = (a + 1) % 3, g = (a + 2) % 3, low = side << a;
    const int corners[4] = {low, low | 1 << e, low | 1 << e | 1 << g, low | 1 << g};
    T one[3], other[3], m[3];  // diagonals, centre
    for (int d = 0; d < 3; ++d) {
      one[d] = x[corners[2]][d] - x[corners[0]][d];
      other[d] = x[corners[3]][d] - x[corners[1]][d];
      m[d] = 0.25 * ((x[corners[0]][d] + x[corners[2]][d]) + (x[corners[1]][d] + x[corners[3]][d]));
    }
    T whole[3] = {};
    add_cross(sign / 24, one, other, whole);
    // x_prev - x_next: of the four in turn other, -one, -other, one.
    for (int n = 0; n < 4; ++n) {
      const double turn = (n == 0 || n == 3 ? sign : -sign) / 6;
      T to_corner[3];
      T(&of)[3] = b[corners[n]];
      for (int d = 0; d < 3; ++d) {
        to_corner[d] = x[corners[n]][d] - m[d];
        of[d] += whole[d];
      }
      add_cross(turn, n % 2 == 0 ? other : one, to_corner, of);
    }
  }
};

// Corners from columns: component d of corner c in column 3 c + d; `at`: OneOf or EightOf.
template <int D, std::size_t N, class At>
[[gnu::always_inline]] inline void read_carried(const std::array<const double*, N>& columns,
                                                const std::array<int, 3>& active, const At& at,
                                                typename At::Number (&to)[1 << D][D]) {
  for (std::size_t c = 0; c < std::size_t{1} << D; ++c)
    for (std::size_t a = 0; a < D; ++a) to[c][a] = at(columns[3 * c + active[a]]);
}

}  // namespace sluice::solids
