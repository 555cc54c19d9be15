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

// What is asked for beside v*: moments, its change, gradients.
struct Asked {
  bool moments, changes, gradients;
};

// Sums over the first A axes: v* and its change, and (A each) sum v* dS/dx_a, sum S v* (x_i -
// x_p)_a.
template <int A, Asked asked>
struct Sums {
  Values<asked.changes> values;
  Four slope[asked.gradients ? A : 1];
  Four moment[asked.moments ? A : 1];
};

template <int N, Asked asked>
[[gnu::always_inline]] inline void read_row(const std::int64_t* node, const double (&w)[N],
                                            const double (&d)[N], const double (&off)[N],
                                            Sums<1, asked>& to) {
  Paired<N, Values<asked.changes>> values;
  Paired<N> slope, moment;
  for (int i = 0; i < N; ++i, node += lanes) {
    Values<asked.changes> all;
    if constexpr (asked.changes)
      all = *reinterpret_cast<const EightAtNode*>(node);
    else
      all = *reinterpret_cast<const FourAtNode*>(node);
    const Four v = velocity_of(all);
    values.add(i, w[i] * all);
    if constexpr (asked.gradients) slope.add(i, d[i] * v);
    if constexpr (asked.moments) moment.add(i, off[i] * v);
  }
  values.sum(to.values);
  if constexpr (asked.gradients) to.slope[0] = slope.sum();
  if constexpr (asked.moments) to.moment[0] = moment.sum();
}

// Sums over axes 0 to A from those over axes 0 to A - 1 at the N places of axis A.
template <int N, int A, Asked asked, class At>
[[gnu::always_inline]] inline void join(const AxisWeights<N>& axis, int q, const At& at,
                                        Sums<A + 1, asked>& to) {
  Paired<N, Values<asked.changes>> values;
  Paired<N> slope[A + 1], moment[asked.moments ? A + 1 : 1];
  for (int i = 0; i < N; ++i) {
    Sums<A, asked> s;
    at(i, s);
    const double w = axis.w[i][q];
    const Four v = velocity_of(s.values);
    values.add(i, w * s.values);
    if constexpr (asked.gradients) {
      for (int a = 0; a < A; ++a) slope[a].add(i, w * s.slope[a]);
      slope[A].add(i, axis.d[i][q] * v);
    }
    if constexpr (asked.moments) {
      for (int a = 0; a < A; ++a) moment[a].add(i, w * s.moment[a]);
      moment[A].add(i, (w * axis.off[i][q]) * v);
    }
  }
  values.sum(to.values);
  for (int a = 0; a <= A; ++a) {
    if constexpr (asked.gradients) to.slope[a] = slope[a].sum();
    if constexpr (asked.moments) to.moment[a] = moment[a].sum();
  }
}

template <int D, int N, Asked asked>
[[gnu::always_inline]] inline void read_particle(const AxisWeights<N> (&w)[D], int q,
                                                 const std::int64_t* node,
                                                 const std::ptrdiff_t (&stride)[D],
                                                 Sums<D, asked>& to) {
  double wx[N], dx[N], off[N];
  for (int i = 0; i < N; ++i) {
    wx[i] = w[0].w[i][q];
    dx[i] = w[0].d[i][q];
    off[i] = asked.moments ? wx[i] * w[0].off[i][q] : 0.0;
  }
  const auto row = [&](const std::int64_t* at, Sums<1, asked>& of_row)
                       [[gnu::always_inline]] { read_row<N, asked>(at, wx, dx, off, of_row); };
  if constexpr (D == 1) {
    row(node, to);
  } else {
    const auto plane = [&](const std::int64_t* at, Sums<2, asked>& of_plane)
                           [[gnu::always_inline]] {
                             join<N, 1, asked>(
                                 w[1], q,
                                 [&](int j, Sums<1, asked>& of_row)
                                     [[gnu::always_inline]] { row(at + j * stride[1], of_row); },
                                 of_plane);
                           };
    if constexpr (D == 2)
      plane(node, to);
    else
      join<N, 2, asked>(
          w[2], q,
          [&](int k, Sums<2, asked>& of_plane)
              [[gnu::always_inline]] { plane(node + k * stride[2], of_plane); },
          to);
  }
}

template <int D, class B, Asked asked>
void read(Basis basis, const TransferGrid& grid, const std::array<const double*, 3>& x,
          const ParticleShape& shape, int at, int n, const Window& window, GridAtParticles& to) {
  alignas(64) static thread_local AxisWeights<B::nodes> w[D];
  for (int a = 0; a < D; ++a)
    weights_of<B, asked.moments>(basis, grid, x, shape, grid.active[a], at, n, w[a]);
  const WindowAxes<D> axes(grid, window);
  const std::int64_t* nodes = window.at(0, 0, 0);
  for (int q = 0; q < n; ++q) {
    const std::int64_t* node = nodes;
    for (int a = 0; a < D; ++a) node += (w[a].first[q] - axes.low[a]) * axes.stride[a];
    Sums<D, asked> s;
    read_particle<D, B::nodes, asked>(w, q, node, axes.stride, s);
    if constexpr (!asked.changes) to.fourth[q] = s.values[3];
    for (int e = 0; e < 3; ++e) {
      to.u[e][q] = s.values[e];
      if constexpr (asked.changes) to.dv[e][q] = s.values[4 + e];
      for (int a = 0; a < D; ++a) {
        const int d = grid.active[a];
        if constexpr (asked.gradients) to.L[3 * e + d][q] = s.slope[a][e];
        if constexpr (asked.moments) to.moment[3 * e + d][q] = s.moment[a][e];
      }
    }
  }
  if constexpr (asked.gradients) clear_inactive(grid, n, asked.moments, to);
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
  if (by_corners(basis))
    return read_corners(basis, grid, x, shape, at, n, Reading::all, window, to);
  for_basis(basis, has_own_widths(basis, shape), grid.count, [&]<int D, class B>() {
    moments ? read<D, B, Asked{true, true, true}>(basis, grid, x, shape, at, n, window, to)
            : read<D, B, Asked{false, true, true}>(basis, grid, x, shape, at, n, window, to);
  });
}

void read_motion(Basis basis, const TransferGrid& grid, const std::array<const double*, 3>& x,
                 const ParticleShape& shape, int at, int n, const Window& window,
                 GridAtParticles& to) {
  if (by_corners(basis))
    return read_corners(basis, grid, x, shape, at, n, Reading::motion, window, to);
  for_basis(basis, has_own_widths(basis, shape), grid.count, [&]<int D, class B>() {
    read<D, B, Asked{false, true, false}>(basis, grid, x, shape, at, n, window, to);
  });
}

void read_velocities(Basis basis, const TransferGrid& grid, const std::array<const double*, 3>& x,
                     const ParticleShape& shape, int at, int n, const Window& window,
                     GridAtParticles& to) {
  if (by_corners(basis))
    return read_corners(basis, grid, x, shape, at, n, Reading::velocities, window, to);
  for_basis(basis, has_own_widths(basis, shape), grid.count, [&]<int D, class B>() {
    read<D, B, Asked{false, false, true}>(basis, grid, x, shape, at, n, window, to);
  });
}

}  // namespace sluice::mpm
