// Impulses on nodes to particles with corners: changes of velocity and their moments.
//
//   sum_i S r_a dv_i = 1/C sum_c (w_c,a dv(x_c) + h_a (1/4 - s_a^2) h_a d(dv)/dx_a (x_c))
//
// of C corners w_c from the particle, each s from the middle of its cell, in cells: the sum of
// N_i(x_c) (x_i - x_c) is zero along each direction, that of its squares h^2 (1/4 - s^2).
#include <algorithm>

#include "mpm/nodes/node_sums.hpp"
#include "mpm/transfer/corner_transfer.hpp"
#include "mpm/transfer/corners.hpp"
#include "mpm/transfer/window_axes.hpp"

namespace sluice::mpm {
namespace {

// At a corner: v*, its change, and sum N_i (x_i - x_c)_a of that, cells.
template <int D>
struct Impulse {
  Four velocity, change, moment[D];
};

template <int D>
struct HatSums {
  Four change[1 << D], velocity[1 << D], moment[D][1 << D];
};

// Hats along axis A at s: what is left are the nodes of the axes behind.
template <int A, bool Velocities, int D>
[[gnu::always_inline]] inline void fold(double s, HatSums<D>& sums) {
  const double low = 0.5 - s, up = 0.5 + s, square = 0.25 - s * s;
#pragma GCC unroll 4
  for (int i = 0; i < 1 << (D - 1 - A); ++i) {
    const auto along = [&](Four* of) { of[i] = low * of[2 * i] + up * of[2 * i + 1]; };
    if constexpr (Velocities) along(sums.velocity);
    sums.moment[A][i] = square * (sums.change[2 * i + 1] - sums.change[2 * i]);
    if constexpr (A > 0) along(sums.moment[0]);
    if constexpr (A > 1) along(sums.moment[1]);
    along(sums.change);
  }
}

// Hats, axis after axis: of changes alone, as moments are differences of these.
template <int D, bool Velocities>
[[gnu::always_inline]] inline void at_corner(const std::int64_t* node,
                                             const std::ptrdiff_t (&stride)[D],
                                             const double (&s)[D], Impulse<D>& to) {
  HatSums<D> sums;
#pragma GCC unroll 8
  for (int i = 0; i < 1 << D; ++i) {
    const std::int64_t* from = node;
    for (int a = 0; a < D; ++a) from += (i >> a & 1) * stride[a];
    if constexpr (Velocities) sums.velocity[i] = *reinterpret_cast<const FourAtNode*>(from);
    sums.change[i] = *reinterpret_cast<const FourAtNode*>(from + 4);
  }
  fold<0, Velocities>(s[0], sums);
  if constexpr (D > 1) fold<1, Velocities>(s[1], sums);
  if constexpr (D > 2) fold<2, Velocities>(s[2], sums);
  if constexpr (Velocities) to.velocity = sums.velocity[0];
  to.change = sums.change[0];
  for (int a = 0; a < D; ++a) to.moment[a] = sums.moment[a][0];
}

// sum S r_a^2 of each active direction, from which I is made.
template <int D, bool Tetrahedron>
void add_inertia(const TransferGrid& grid, const Corners<D, Tetrahedron>& corners, int n,
                 ImpulsesAtParticles& to) {
  using Corner = Corners<D, Tetrahedron>;
  for (auto& of_axis : to.inertia) std::fill_n(of_axis, n, 0.0);
  for (int a = 0; a < D; ++a) {
    const int d = grid.active[a];
    const double h = grid.axes[d].spacing;
    alignas(64) double square[chunk_size];
    for (int q = 0; q < n; ++q) {
      double part[Corner::count];
      for (int c = 0; c < Corner::count; ++c) {
        const double s = corners.s[c][a][q], way = corners.way[c][a][q];
        part[c] = way * way + (0.25 - s * s);
      }
      square[q] = corner_sum(part) * (Corner::share * h * h);
    }
    for (int k = 0; k < 3; ++k)
      for (int q = 0; q < n && k != d; ++q) to.inertia[k][q] += square[q];
  }
}

template <int D, bool Tetrahedron, bool Velocities>
void read(const TransferGrid& grid, const std::array<const double*, 3>& x,
          const ParticleShape& shape, int at, int n, const Window& window,
          ImpulsesAtParticles& to) {
  using Corner = Corners<D, Tetrahedron>;
  static thread_local Corner corners;
  find_corners(grid, x, shape, at, n, Slopes::unused, corners);
  add_inertia(grid, corners, n, to);
  const WindowAxes<D> axes(grid, window);
  double scale[D];
  for (int a = 0; a < D; ++a) scale[a] = Corner::share * grid.axes[grid.active[a]].spacing;
  const std::int64_t* nodes = window.at(0, 0, 0);
  const bool carried = shape.corners[0] != nullptr;
  for (int q = 0; q < n; ++q) {
    Four velocity[Corner::count], change[Corner::count], part[D][Corner::count];
    for (int c = 0; c < Corner::count; ++c) {
      const std::int64_t* node = nodes;
      double s[D];
      for (int a = 0; a < D; ++a) {
        s[a] = corners.s[c][a][q];
        node += (corners.first[c][a][q] - axes.low[a]) * axes.stride[a];
      }
      Impulse<D> v;
      at_corner<D, Velocities>(node, axes.stride, s, v);
      if constexpr (Velocities) velocity[c] = v.velocity;
      for (int e = 0; e < 3 && Velocities && carried; ++e) to.corner[c][e][q] = v.velocity[e];
      change[c] = v.change;
      for (int a = 0; a < D; ++a) part[a][c] = corners.way[c][a][q] * v.change + v.moment[a];
    }
    const Four dv = corner_sum(change) * Corner::share;
    Four u{};
    if constexpr (Velocities) u = corner_sum(velocity) * Corner::share;
    double moment[3][3] = {};  // r_d dv_e
    for (int a = 0; a < D; ++a) {
      const Four sum = corner_sum(part[a]) * scale[a];
      for (int e = 0; e < 3; ++e) moment[grid.active[a]][e] = sum[e];
    }
    for (int e = 0; e < 3; ++e) {
      if constexpr (Velocities) to.u[e][q] = u[e];
      to.dv[e][q] = dv[e];
      to.turn[e][q] = moment[(e + 1) % 3][(e + 2) % 3] - moment[(e + 2) % 3][(e + 1) % 3];
    }
  }
}

}  // namespace

void read_impulses_of_corners(Basis basis, const TransferGrid& grid,
                              const std::array<const double*, 3>& x, const ParticleShape& shape,
                              int at, int n, bool velocities, const Window& window,
                              ImpulsesAtParticles& to) {
  const auto go = [&]<int D, bool Tetrahedron>() {
    velocities ? read<D, Tetrahedron, true>(grid, x, shape, at, n, window, to)
               : read<D, Tetrahedron, false>(grid, x, shape, at, n, window, to);
  };
  if (basis == Basis::cpti) return go.template operator()<3, true>();
  if (grid.count == 3) return go.template operator()<3, false>();
  if (grid.count == 2) return go.template operator()<2, false>();
  go.template operator()<1, false>();
}

}  // namespace sluice::mpm
