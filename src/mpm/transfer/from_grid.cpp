#include "mpm/transfer/from_grid.hpp"

#include "mpm/transfer/corner_transfer.hpp"
#include "mpm/transfer/dispatch.hpp"
#include "mpm/transfer/paired_sum.hpp"

namespace sluice::mpm {
namespace {

// Sums over the first A axes: v*, its change, and (A each) sum v* dS/dx_a, sum S v* (x_i - x_p)_a.
template <int A, bool Moments>
struct Sums {
  Four velocity, change;
  Four slope[A];
  Four moment[Moments ? A : 1];
};

template <int N, bool Moments>
[[gnu::always_inline]] inline Sums<1, Moments> read_row(const std::int64_t* node,
                                                        const double (&w)[N], const double (&d)[N],
                                                        const double (&off)[N]) {
  Paired<N> velocity, change, slope, moment;
  for (int i = 0; i < N; ++i, node += lanes) {
    const Four v = *reinterpret_cast<const FourAtNode*>(node);
    const Four c = *reinterpret_cast<const FourAtNode*>(node + 4);
    velocity.add(i, w[i] * v);
    change.add(i, w[i] * c);
    slope.add(i, d[i] * v);
    if constexpr (Moments) moment.add(i, off[i] * v);
  }
  Sums<1, Moments> to;
  to.velocity = velocity.sum();
  to.change = change.sum();
  to.slope[0] = slope.sum();
  if constexpr (Moments) to.moment[0] = moment.sum();
  return to;
}

// Sums over axes 0 to A from those over axes 0 to A - 1 at the N places of axis A.
template <int N, int A, bool Moments, class At>
[[gnu::always_inline]] inline Sums<A + 1, Moments> join(const AxisWeights<N>& axis, int q,
                                                        const At& at) {
  Paired<N> velocity, change, slope[A + 1], moment[Moments ? A + 1 : 1];
  for (int i = 0; i < N; ++i) {
    const Sums<A, Moments> s = at(i);
    const double w = axis.w[i][q];
    velocity.add(i, w * s.velocity);
    change.add(i, w * s.change);
    for (int a = 0; a < A; ++a) slope[a].add(i, w * s.slope[a]);
    slope[A].add(i, axis.d[i][q] * s.velocity);
    if constexpr (Moments) {
      for (int a = 0; a < A; ++a) moment[a].add(i, w * s.moment[a]);
      moment[A].add(i, (w * axis.off[i][q]) * s.velocity);
    }
  }
  Sums<A + 1, Moments> to;
  to.velocity = velocity.sum();
  to.change = change.sum();
  for (int a = 0; a <= A; ++a) {
    to.slope[a] = slope[a].sum();
    if constexpr (Moments) to.moment[a] = moment[a].sum();
  }
  return to;
}

template <int D, int N, bool Moments>
[[gnu::always_inline]] inline Sums<D, Moments> read_particle(const AxisWeights<N> (&w)[D], int q,
                                                             const std::int64_t* node,
                                                             const std::ptrdiff_t (&stride)[D]) {
  double wx[N], dx[N], off[N];
  for (int i = 0; i < N; ++i) {
    wx[i] = w[0].w[i][q];
    dx[i] = w[0].d[i][q];
    off[i] = Moments ? wx[i] * w[0].off[i][q] : 0.0;
  }
  const auto row = [&](const std::int64_t* at)
                       [[gnu::always_inline]] { return read_row<N, Moments>(at, wx, dx, off); };
  if constexpr (D == 1) {
    return row(node);
  } else if constexpr (D == 2) {
    return join<N, 1, Moments>(
        w[1], q, [&](int j) [[gnu::always_inline]] { return row(node + j * stride[1]); });
  } else {
    return join<N, 2, Moments>(w[2], q, [&](int k) [[gnu::always_inline]] {
      return join<N, 1, Moments>(w[1], q, [&](int j) [[gnu::always_inline]] {
        return row(node + k * stride[2] + j * stride[1]);
      });
    });
  }
}

template <int D, class B, bool Moments>
void read(Basis basis, const TransferGrid& grid, const std::array<const double*, 3>& x,
          const ParticleShape& shape, int at, int n, const Window& window, GridAtParticles& to) {
  alignas(64) static thread_local AxisWeights<B::nodes> w[D];
  for (int a = 0; a < D; ++a)
    weights_of<B, Moments>(basis, grid, x, shape, grid.active[static_cast<std::size_t>(a)], at, n,
                           w[a]);
  std::ptrdiff_t stride[D];
  int low[D];
  for (int a = 0; a < D; ++a) {
    const int d = grid.active[static_cast<std::size_t>(a)];
    stride[a] = window.stride(d);
    low[a] = window.lower()[d];
  }
  const std::int64_t* nodes = window.at(0, 0, 0);
  for (int q = 0; q < n; ++q) {
    const std::int64_t* node = nodes;
    for (int a = 0; a < D; ++a) node += (w[a].first[q] - low[a]) * stride[a];
    const Sums<D, Moments> s = read_particle<D, B::nodes, Moments>(w, q, node, stride);
    for (int e = 0; e < 3; ++e) {
      to.u[e][q] = s.velocity[e];
      to.dv[e][q] = s.change[e];
      for (int a = 0; a < D; ++a) {
        const int d = grid.active[static_cast<std::size_t>(a)];
        to.L[3 * e + d][q] = s.slope[a][e];
        if constexpr (Moments) to.moment[3 * e + d][q] = s.moment[a][e];
      }
    }
  }
  clear_inactive(grid, n, Moments, to);
}

}  // namespace

void clear_inactive(const TransferGrid& grid, int n, bool moments, GridAtParticles& to) {
  for (int d = 0; d < 3; ++d) {
    bool active = false;
    for (int a = 0; a < grid.count; ++a) active |= grid.active[static_cast<std::size_t>(a)] == d;
    if (active) continue;
    for (int e = 0; e < 3; ++e)
      for (int q = 0; q < n; ++q) {
        to.L[3 * e + d][q] = 0;
        if (moments) to.moment[3 * e + d][q] = 0;
      }
  }
}

void read_window(Basis basis, const TransferGrid& grid, const std::array<const double*, 3>& x,
                 const ParticleShape& shape, int at, int n, bool moments, const Window& window,
                 GridAtParticles& to) {
  if (by_corners(basis)) return read_corners(basis, grid, x, shape, at, n, window, to);
  for_basis(basis, has_own_widths(basis, shape), grid.count, [&]<int D, class B>() {
    moments ? read<D, B, true>(basis, grid, x, shape, at, n, window, to)
            : read<D, B, false>(basis, grid, x, shape, at, n, window, to);
  });
}

}  // namespace sluice::mpm
