#include "mpm/transfer/to_grid.hpp"

#include <algorithm>

#include "mpm/nodes/node_sums.hpp"
#include "mpm/transfer/corner_transfer.hpp"
#include "mpm/transfer/dispatch.hpp"
#include "mpm/transfer/gifts.hpp"
#include "mpm/transfer/window_axes.hpp"

namespace sluice::mpm {
namespace {

// Adds to the nodes of one particle, a row along the first axis at a time. Nodes of the first
// active direction follow each other in memory: those that are not active have one layer. `loaded`:
// particles have loads.
template <int D, int N, bool Affine, bool Forces>
[[gnu::always_inline]] inline void add_particle(const NodalContribution& g,
                                                const AxisWeights<N> (&w)[D], int q,
                                                std::int64_t* nodes,
                                                const std::ptrdiff_t (&stride)[D], bool loaded) {
  constexpr int rows = D > 1 ? N : 1, planes = D > 2 ? N : 1;
  double wx[N], dx[N], off[N];
  for (int i = 0; i < N; ++i) {
    wx[i] = w[0].w[i][q];
    dx[i] = w[0].d[i][q];
    if constexpr (Affine) off[i] = wx[i] * w[0].off[i][q];
  }
  Four mass_of_row[rows];  // without what varies from plane to plane
  for (int j = 0; j < rows; ++j) {
    mass_of_row[j] = g.mass_momentum;
    if constexpr (Affine && D > 1) mass_of_row[j] += g.affine[1] * w[1].off[j][q];
  }
  for (int k = 0; k < planes; ++k) {
    const double wz = D > 2 ? w[D - 1].w[k][q] : 1.0, dz = D > 2 ? w[D - 1].d[k][q] : 0.0;
    Four mass_of_plane{};
    if constexpr (Affine && D > 2) mass_of_plane = g.affine[2] * w[2].off[k][q];
    for (int j = 0; j < rows; ++j) {
      constexpr int y = D > 1 ? 1 : 0;
      const double wy = D > 1 ? w[y].w[j][q] : 1.0, dy = D > 1 ? w[y].d[j][q] : 0.0;
      const double wyz = wy * wz;
      std::int64_t* node = nodes;
      if constexpr (D > 1) node += j * stride[1];
      if constexpr (D > 2) node += k * stride[2];
      Four mass = mass_of_row[j];
      if constexpr (Affine && D > 2) mass += mass_of_plane;
      mass *= wyz;
      if constexpr (Forces) {
        Four force = loaded ? g.load * wyz : Four{};
        if constexpr (D > 1) force += g.traction[1] * (dy * wz);
        if constexpr (D > 2) force += g.traction[2] * (wy * dz);
        const Four slope = Affine ? g.affine[0] * wyz : Four{}, pull = g.traction[0] * wyz;
        for (int i = 0; i < N; ++i, node += lanes) {
          Four momentum = mass * wx[i];
          if constexpr (Affine) momentum += slope * off[i];
          add_rounded(node, momentum);
          add_rounded(node + 4, force * wx[i] + pull * dx[i]);
        }
      } else {
        const Four slope = Affine ? g.affine[0] * wyz : Four{};
        for (int i = 0; i < N; ++i, node += lanes) {
          Four momentum = mass * wx[i];
          if constexpr (Affine) momentum += slope * off[i];
          add_rounded(node, momentum);
          node[count_lane] = wrapped_sum(node[count_lane], rounding_bits);
        }
      }
    }
  }
}

template <int D, class B, bool Affine, bool Forces>
void add_block(Basis basis, const TransferGrid& grid, const ParticlesToGrid& p, int begin, int end,
               const SumUnits& units, Window& window) {
  alignas(64) static thread_local AxisWeights<B::nodes> weights[D];
  static thread_local NodalContribution gifts[chunk_size];
  const WindowAxes<D> axes(grid, window);
  std::int64_t* nodes = window.at(0, 0, 0);
  const bool loaded = p.load[0] != nullptr;
  for (int at = begin; at < end; at += chunk_size) {
    const int n = std::min(chunk_size, end - at);
    for (int a = 0; a < D; ++a)
      weights_of<B, Affine>(basis, grid, p.x, p.shape, grid.active[a], at, n, weights[a]);
    nodal_contributions(grid, p, at, n, units, gifts);
    for (int q = 0; q < n; ++q) {
      std::int64_t* node = nodes;
      for (int a = 0; a < D; ++a) node += (weights[a].first[q] - axes.low[a]) * axes.stride[a];
      add_particle<D, B::nodes, Affine, Forces>(gifts[q], weights, q, node, axes.stride, loaded);
    }
  }
}

}  // namespace

int reach_of(Basis basis) {
  return basis == Basis::cubic ? 2 : 1;
}

void add_to_window(Basis basis, const TransferGrid& grid, const ParticlesToGrid& p, int begin,
                   int end, const SumUnits& units, Window& window) {
  if (by_corners(basis)) return add_corners(basis, grid, p, begin, end, units, window);
  const bool affine = p.varies();
  for_basis(basis, has_own_widths(basis, p.shape), grid.count, [&]<int D, class B>() {
    const auto add = [&]<bool Affine>() {
      p.volume != nullptr || p.load[0] != nullptr
          ? add_block<D, B, Affine, true>(basis, grid, p, begin, end, units, window)
          : add_block<D, B, Affine, false>(basis, grid, p, begin, end, units, window);
    };
    affine ? add.template operator()<true>() : add.template operator()<false>();
  });
}

}  // namespace sluice::mpm
