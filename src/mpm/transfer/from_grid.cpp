#include "mpm/transfer/from_grid.hpp"

#include "mpm/nodes/node_sums.hpp"
#include "mpm/transfer/corner_transfer.hpp"
#include "mpm/transfer/dispatch.hpp"

namespace sluice::mpm {
namespace {

// A sum over the nodes of a stencil whose mirror image has the mirrored bits.
template <int N>
inline Four paired(const Four (&v)[N]) {
  if constexpr (N == 1) return v[0];
  if constexpr (N == 2) return v[0] + v[1];
  if constexpr (N == 3) return (v[0] + v[2]) + v[1];
  if constexpr (N == 4) return (v[0] + v[3]) + (v[1] + v[2]);
}

// Sums so far of v* and its change, with the weights of the axes already summed over.
struct Sums {
  Four velocity, change;
  Four slope[3];   // sum v* dS/dx_a
  Four moment[3];  // sum S v* (x_i - x_p)_a
};

// Joins N sums along axis A, of which the axes below have been summed.
template <int N, int A, bool Moments>
inline Sums join(const Sums (&s)[N], const AxisWeights<N>& w, int q) {
  Sums to{};
  Four part[N];
  const auto sum = [&](auto&& term) {
    for (int i = 0; i < N; ++i) part[i] = term(i);
    return paired<N>(part);
  };
  to.velocity = sum([&](int i) { return w.w[i][q] * s[i].velocity; });
  to.change = sum([&](int i) { return w.w[i][q] * s[i].change; });
  for (int a = 0; a < A; ++a) to.slope[a] = sum([&](int i) { return w.w[i][q] * s[i].slope[a]; });
  to.slope[A] = sum([&](int i) { return w.d[i][q] * s[i].velocity; });
  if constexpr (Moments) {
    for (int a = 0; a < A; ++a)
      to.moment[a] = sum([&](int i) { return w.w[i][q] * s[i].moment[a]; });
    to.moment[A] = sum([&](int i) { return (w.w[i][q] * w.off[i][q]) * s[i].velocity; });
  }
  return to;
}

template <int N, bool Moments>
inline Sums read_row(const std::int64_t* node, const AxisWeights<N>& w, int q) {
  Sums nodes[N];
  for (int i = 0; i < N; ++i, node += lanes) {
    nodes[i].velocity = *reinterpret_cast<const FourAtNode*>(node);
    nodes[i].change = *reinterpret_cast<const FourAtNode*>(node + 4);
  }
  return join<N, 0, Moments>(nodes, w, q);
}

template <int D, class B, bool Moments>
Sums read_particle(const AxisWeights<B::nodes> (&w)[D], int q, IntVec3 first,
                   const TransferGrid& grid, const Window& window) {
  constexpr int N = B::nodes;
  const auto row = [&](int j, int k) {
    IntVec3 node = first;
    if constexpr (D > 1) node[grid.active[1]] += j;
    if constexpr (D > 2) node[grid.active[2]] += k;
    return read_row<N, Moments>(window.at(node.x, node.y, node.z), w[0], q);
  };
  if constexpr (D == 1) {
    return row(0, 0);
  } else {
    const auto plane = [&](int k) {
      Sums rows[N];
      for (int j = 0; j < N; ++j) rows[j] = row(j, k);
      return join<N, 1, Moments>(rows, w[1], q);
    };
    if constexpr (D == 2) {
      return plane(0);
    } else {
      Sums planes[N];
      for (int k = 0; k < N; ++k) planes[k] = plane(k);
      return join<N, 2, Moments>(planes, w[2], q);
    }
  }
}

template <int D, class B, bool Moments>
void read(Basis basis, const TransferGrid& grid, const std::array<const double*, 3>& x,
          const ParticleShape& shape, int at, int n, const Window& window, GridAtParticles& to) {
  alignas(64) static thread_local AxisWeights<B::nodes> w[D];
  for (int a = 0; a < D; ++a)
    weights_of<B, Moments>(basis, grid, x, shape, grid.active[static_cast<std::size_t>(a)], at, n,
                           w[a]);
  const IntVec3 low = window.lower();
  for (int q = 0; q < n; ++q) {
    IntVec3 first{};
    for (int a = 0; a < D; ++a) {
      const int d = grid.active[static_cast<std::size_t>(a)];
      first[d] = w[a].first[q] - low[d];
    }
    const Sums s = read_particle<D, B, Moments>(w, q, first, grid, window);
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
