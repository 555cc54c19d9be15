#include "mpm/transfer/from_grid.hpp"

#include "mpm/transfer/corner_transfer.hpp"
#include "mpm/transfer/dispatch.hpp"
#include "mpm/transfer/paired_sum.hpp"
#include "mpm/transfer/window_axes.hpp"

namespace sluice::mpm {
namespace {

// v* of a node or a sum, with its change where that is asked for.
template <bool Changes>
struct ValuesOf {
  using Lanes = Eight;
};
template <>
struct ValuesOf<false> {
  using Lanes = Four;
};
template <bool Changes>
using Values = typename ValuesOf<Changes>::Lanes;
[[gnu::always_inline]] inline Four velocity_of(const Four& values) {
  return values;
}
[[gnu::always_inline]] inline Four velocity_of(const Eight& values) {
  return __builtin_shufflevector(values, values, 0, 1, 2, 3);
}

// Sums over the first A axes: v* and its change, and (A each) sum v* dS/dx_a, sum S v* (x_i -
// x_p)_a.
template <int A, bool Moments, bool Changes>
struct Sums {
  Values<Changes> values;
  Four slope[A];
  Four moment[Moments ? A : 1];
};

template <int N, bool Moments, bool Changes>
[[gnu::always_inline]] inline void read_row(const std::int64_t* node, const double (&w)[N],
                                            const double (&d)[N], const double (&off)[N],
                                            Sums<1, Moments, Changes>& to) {
  Paired<N, Values<Changes>> values;
  Paired<N> slope, moment;
  for (int i = 0; i < N; ++i, node += lanes) {
    Values<Changes> all;
    if constexpr (Changes)
      all = *reinterpret_cast<const EightAtNode*>(node);
    else
      all = *reinterpret_cast<const FourAtNode*>(node);
    const Four v = velocity_of(all);
    values.add(i, w[i] * all);
    slope.add(i, d[i] * v);
    if constexpr (Moments) moment.add(i, off[i] * v);
  }
  values.sum(to.values);
  to.slope[0] = slope.sum();
  if constexpr (Moments) to.moment[0] = moment.sum();
}

// Sums over axes 0 to A from those over axes 0 to A - 1 at the N places of axis A.
template <int N, int A, bool Moments, bool Changes, class At>
[[gnu::always_inline]] inline void join(const AxisWeights<N>& axis, int q, const At& at,
                                        Sums<A + 1, Moments, Changes>& to) {
  Paired<N, Values<Changes>> values;
  Paired<N> slope[A + 1], moment[Moments ? A + 1 : 1];
  for (int i = 0; i < N; ++i) {
    Sums<A, Moments, Changes> s;
    at(i, s);
    const double w = axis.w[i][q];
    const Four v = velocity_of(s.values);
    values.add(i, w * s.values);
    for (int a = 0; a < A; ++a) slope[a].add(i, w * s.slope[a]);
    slope[A].add(i, axis.d[i][q] * v);
    if constexpr (Moments) {
      for (int a = 0; a < A; ++a) moment[a].add(i, w * s.moment[a]);
      moment[A].add(i, (w * axis.off[i][q]) * v);
    }
  }
  values.sum(to.values);
  for (int a = 0; a <= A; ++a) {
    to.slope[a] = slope[a].sum();
    if constexpr (Moments) to.moment[a] = moment[a].sum();
  }
}

template <int D, int N, bool Moments, bool Changes>
[[gnu::always_inline]] inline void read_particle(const AxisWeights<N> (&w)[D], int q,
                                                 const std::int64_t* node,
                                                 const std::ptrdiff_t (&stride)[D],
                                                 Sums<D, Moments, Changes>& to) {
  double wx[N], dx[N], off[N];
  for (int i = 0; i < N; ++i) {
    wx[i] = w[0].w[i][q];
    dx[i] = w[0].d[i][q];
    off[i] = Moments ? wx[i] * w[0].off[i][q] : 0.0;
  }
  const auto row =
      [&](const std::int64_t* at, Sums<1, Moments, Changes>& of_row)
          [[gnu::always_inline]] { read_row<N, Moments, Changes>(at, wx, dx, off, of_row); };
  if constexpr (D == 1) {
    row(node, to);
  } else {
    const auto plane = [&](const std::int64_t* at, Sums<2, Moments, Changes>& of_plane)
                           [[gnu::always_inline]] {
                             join<N, 1, Moments, Changes>(
                                 w[1], q,
                                 [&](int j, Sums<1, Moments, Changes>& of_row)
                                     [[gnu::always_inline]] { row(at + j * stride[1], of_row); },
                                 of_plane);
                           };
    if constexpr (D == 2)
      plane(node, to);
    else
      join<N, 2, Moments, Changes>(
          w[2], q,
          [&](int k, Sums<2, Moments, Changes>& of_plane)
              [[gnu::always_inline]] { plane(node + k * stride[2], of_plane); },
          to);
  }
}

template <int D, class B, bool Moments, bool Changes>
void read(Basis basis, const TransferGrid& grid, const std::array<const double*, 3>& x,
          const ParticleShape& shape, int at, int n, const Window& window, GridAtParticles& to) {
  alignas(64) static thread_local AxisWeights<B::nodes> w[D];
  for (int a = 0; a < D; ++a)
    weights_of<B, Moments>(basis, grid, x, shape, grid.active[a], at, n, w[a]);
  const WindowAxes<D> axes(grid, window);
  const std::int64_t* nodes = window.at(0, 0, 0);
  for (int q = 0; q < n; ++q) {
    const std::int64_t* node = nodes;
    for (int a = 0; a < D; ++a) node += (w[a].first[q] - axes.low[a]) * axes.stride[a];
    Sums<D, Moments, Changes> s;
    read_particle<D, B::nodes, Moments, Changes>(w, q, node, axes.stride, s);
    if constexpr (!Changes) to.fourth[q] = s.values[3];
    for (int e = 0; e < 3; ++e) {
      to.u[e][q] = s.values[e];
      if constexpr (Changes) to.dv[e][q] = s.values[4 + e];
      for (int a = 0; a < D; ++a) {
        const int d = grid.active[a];
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
    for (int a = 0; a < grid.count; ++a) active |= grid.active[a] == d;
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
  if (by_corners(basis)) return read_corners(basis, grid, x, shape, at, n, true, window, to);
  for_basis(basis, has_own_widths(basis, shape), grid.count, [&]<int D, class B>() {
    moments ? read<D, B, true, true>(basis, grid, x, shape, at, n, window, to)
            : read<D, B, false, true>(basis, grid, x, shape, at, n, window, to);
  });
}

void read_velocities(Basis basis, const TransferGrid& grid, const std::array<const double*, 3>& x,
                     const ParticleShape& shape, int at, int n, const Window& window,
                     GridAtParticles& to) {
  if (by_corners(basis)) return read_corners(basis, grid, x, shape, at, n, false, window, to);
  for_basis(basis, has_own_widths(basis, shape), grid.count, [&]<int D, class B>() {
    read<D, B, false, false>(basis, grid, x, shape, at, n, window, to);
  });
}

}  // namespace sluice::mpm
