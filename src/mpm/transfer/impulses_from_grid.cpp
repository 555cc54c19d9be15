#include "mpm/transfer/impulses_from_grid.hpp"

#include "mpm/transfer/corner_transfer.hpp"
#include "mpm/transfer/dispatch.hpp"
#include "mpm/transfer/paired_sum.hpp"
#include "mpm/transfer/window_axes.hpp"

namespace sluice::mpm {
namespace {

// Sums over the first A axes: v* (where it is asked for), its change, and moments of that.
template <int A, bool Velocities>
struct Sums {
  Four velocity, change, moment[A];
};

template <int N, bool Velocities>
[[gnu::always_inline]] inline Sums<1, Velocities> read_row(const std::int64_t* node,
                                                           const double (&w)[N],
                                                           const double (&off)[N]) {
  Paired<N> velocity, change, moment;
  for (int i = 0; i < N; ++i, node += lanes) {
    if constexpr (Velocities) velocity.add(i, w[i] * *reinterpret_cast<const FourAtNode*>(node));
    const Four c = *reinterpret_cast<const FourAtNode*>(node + 4);
    change.add(i, w[i] * c);
    moment.add(i, off[i] * c);
  }
  Sums<1, Velocities> to;
  if constexpr (Velocities) to.velocity = velocity.sum();
  to.change = change.sum();
  to.moment[0] = moment.sum();
  return to;
}

// Sums over axes 0 to A from those over axes 0 to A - 1 at the N places of axis A.
template <int N, int A, bool Velocities, class At>
[[gnu::always_inline]] inline Sums<A + 1, Velocities> join(const AxisWeights<N>& axis, int q,
                                                           const At& at) {
  Paired<N> velocity, change, moment[A + 1];
  for (int i = 0; i < N; ++i) {
    const Sums<A, Velocities> s = at(i);
    const double w = axis.w[i][q];
    if constexpr (Velocities) velocity.add(i, w * s.velocity);
    change.add(i, w * s.change);
    for (int a = 0; a < A; ++a) moment[a].add(i, w * s.moment[a]);
    moment[A].add(i, (w * axis.off[i][q]) * s.change);
  }
  Sums<A + 1, Velocities> to;
  if constexpr (Velocities) to.velocity = velocity.sum();
  to.change = change.sum();
  for (int a = 0; a <= A; ++a) to.moment[a] = moment[a].sum();
  return to;
}

template <int D, int N, bool Velocities>
[[gnu::always_inline]] inline Sums<D, Velocities> read_particle(const AxisWeights<N> (&w)[D], int q,
                                                                const std::int64_t* node,
                                                                const std::ptrdiff_t (&stride)[D]) {
  double wx[N], off[N];
  for (int i = 0; i < N; ++i) {
    wx[i] = w[0].w[i][q];
    off[i] = wx[i] * w[0].off[i][q];
  }
  const auto row = [&](const std::int64_t* at)
                       [[gnu::always_inline]] { return read_row<N, Velocities>(at, wx, off); };
  if constexpr (D == 1) {
    return row(node);
  } else if constexpr (D == 2) {
    return join<N, 1, Velocities>(
        w[1], q, [&](int j) [[gnu::always_inline]] { return row(node + j * stride[1]); });
  } else {
    return join<N, 2, Velocities>(w[2], q, [&](int k) [[gnu::always_inline]] {
      return join<N, 1, Velocities>(w[1], q, [&](int j) [[gnu::always_inline]] {
        return row(node + k * stride[2] + j * stride[1]);
      });
    });
  }
}

// sum S r_a^2 of each active direction, from which I is made.
template <int D, int N>
void add_inertia(const TransferGrid& grid, const AxisWeights<N> (&w)[D], int n,
                 ImpulsesAtParticles& to) {
  for (auto& of_axis : to.inertia) std::fill_n(of_axis, n, 0.0);
  for (int a = 0; a < D; ++a) {
    alignas(64) double square[chunk_size];
    for (int q = 0; q < n; ++q) {
      double outer = w[a].w[0][q] * w[a].off[0][q] * w[a].off[0][q] +
                     w[a].w[N - 1][q] * w[a].off[N - 1][q] * w[a].off[N - 1][q];
      double inner = 0;
      for (int i = 1; i + 1 < N; ++i) inner += w[a].w[i][q] * w[a].off[i][q] * w[a].off[i][q];
      square[q] = outer + inner;
    }
    const int d = grid.active[a];
    for (int k = 0; k < 3; ++k)
      for (int q = 0; q < n && k != d; ++q) to.inertia[k][q] += square[q];
  }
}

template <int D, class B, bool Velocities>
void read(Basis basis, const TransferGrid& grid, const std::array<const double*, 3>& x,
          const ParticleShape& shape, int at, int n, const Window& window,
          ImpulsesAtParticles& to) {
  alignas(64) static thread_local AxisWeights<B::nodes> w[D];
  for (int a = 0; a < D; ++a)
    weights_of<B, true>(basis, grid, x, shape, grid.active[a], at, n, w[a]);
  add_inertia<D, B::nodes>(grid, w, n, to);
  const WindowAxes<D> axes(grid, window);
  const std::int64_t* nodes = window.at(0, 0, 0);
  for (int q = 0; q < n; ++q) {
    const std::int64_t* node = nodes;
    for (int a = 0; a < D; ++a) node += (w[a].first[q] - axes.low[a]) * axes.stride[a];
    const Sums<D, Velocities> s = read_particle<D, B::nodes, Velocities>(w, q, node, axes.stride);
    double moment[3][3] = {};  // r_d dv_e
    for (int a = 0; a < D; ++a)
      for (int e = 0; e < 3; ++e) moment[grid.active[a]][e] = s.moment[a][e];
    for (int e = 0; e < 3; ++e) {
      if constexpr (Velocities) to.u[e][q] = s.velocity[e];
      to.dv[e][q] = s.change[e];
      to.turn[e][q] = moment[(e + 1) % 3][(e + 2) % 3] - moment[(e + 2) % 3][(e + 1) % 3];
    }
  }
}

}  // namespace

void interpolate_impulses(Basis basis, const TransferGrid& grid,
                          const std::array<const double*, 3>& x, const ParticleShape& shape, int at,
                          int n, bool velocities, const Window& window, ImpulsesAtParticles& to) {
  if (by_corners(basis))
    return read_impulses_of_corners(basis, grid, x, shape, at, n, velocities, window, to);
  for_basis(basis, has_own_widths(basis, shape), grid.count, [&]<int D, class B>() {
    velocities ? read<D, B, true>(basis, grid, x, shape, at, n, window, to)
               : read<D, B, false>(basis, grid, x, shape, at, n, window, to);
  });
}

}  // namespace sluice::mpm
