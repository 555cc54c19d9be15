#include "mpm/transfer/to_grid.hpp"

#include <algorithm>

#include "mpm/nodes/node_sums.hpp"
#include "mpm/transfer/corner_transfer.hpp"
#include "mpm/transfer/dispatch.hpp"
#include "mpm/transfer/gifts.hpp"

namespace sluice::mpm {
namespace {

template <int D, class B>
using Weights = AxisWeights<B::nodes>[D];

// One row of nodes along the first axis.
template <int N, bool Affine>
inline void add_row(std::int64_t* node, const AxisWeights<N>& x, int q, Four mass, Four slope,
                    Four force, Four pull) {
  for (int i = 0; i < N; ++i, node += lanes) {
    const double w = x.w[i][q], d = x.d[i][q];
    Four momentum = mass * w;
    if constexpr (Affine) momentum += slope * (w * x.off[i][q]);
    add_rounded(node, momentum);
    add_rounded(node + 4, force * w + pull * d);
  }
}

template <int D, class B, bool Affine>
void add_particle(const Gift& g, const Weights<D, B>& w, int q, const IntVec3& low,
                  const TransferGrid& grid, Window& window) {
  constexpr int N = B::nodes;
  constexpr int rows = D > 1 ? N : 1, planes = D > 2 ? N : 1;
  IntVec3 first{};
  for (int a = 0; a < D; ++a) {
    const int d = grid.active[static_cast<std::size_t>(a)];
    first[d] = w[a].first[q] - low[d];
  }
  for (int k = 0; k < planes; ++k) {
    const double wz = D > 2 ? w[D - 1].w[k][q] : 1.0, dz = D > 2 ? w[D - 1].d[k][q] : 0.0;
    for (int j = 0; j < rows; ++j) {
      const double wy = D > 1 ? w[D > 1 ? 1 : 0].w[j][q] : 1.0;
      const double dy = D > 1 ? w[D > 1 ? 1 : 0].d[j][q] : 0.0;
      const double wyz = wy * wz;
      Four mass = g.mass_momentum, force = g.load * wyz;
      if constexpr (D > 1) force += g.traction[1] * (dy * wz);
      if constexpr (D > 2) force += g.traction[2] * (wy * dz);
      Four slope{};
      if constexpr (Affine) {
        slope = g.affine[0] * wyz;
        if constexpr (D > 1) mass += g.affine[1] * w[1].off[j][q];
        if constexpr (D > 2) mass += g.affine[2] * w[2].off[k][q];
      }
      IntVec3 node = first;
      if constexpr (D > 1) node[grid.active[1]] += j;
      if constexpr (D > 2) node[grid.active[2]] += k;
      // Directions that are not active have one layer: nodes of the first active one follow each
      // other in memory.
      add_row<N, Affine>(window.at(node.x, node.y, node.z), w[0], q, mass * wyz, slope, force,
                         g.traction[0] * wyz);
    }
  }
}

template <int D, class B, bool Affine>
void add_block(Basis basis, const TransferGrid& grid, const ParticlesToGrid& p, int begin, int end,
               const SumUnits& units, Window& window) {
  alignas(64) static thread_local Weights<D, B> weights;
  static thread_local Gift gifts[chunk_size];
  for (int at = begin; at < end; at += chunk_size) {
    const int n = std::min(chunk_size, end - at);
    for (int a = 0; a < D; ++a)
      weights_of<B, Affine>(basis, grid, p.x, p.shape, grid.active[static_cast<std::size_t>(a)], at,
                            n, weights[a]);
    make_gifts(grid, p, at, n, units, gifts);
    for (int q = 0; q < n; ++q)
      add_particle<D, B, Affine>(gifts[q], weights, q, window.lower(), grid, window);
  }
}

}  // namespace

int reach_of(Basis basis) {
  return basis == Basis::cubic ? 2 : 1;
}

void add_to_window(Basis basis, const TransferGrid& grid, const ParticlesToGrid& p, int begin,
                   int end, const SumUnits& units, Window& window) {
  if (by_corners(basis)) return add_corners(basis, grid, p, begin, end, units, window);
  const bool affine = p.affine[0] != nullptr;
  for_basis(basis, has_own_widths(basis, p.shape), grid.count, [&]<int D, class B>() {
    affine ? add_block<D, B, true>(basis, grid, p, begin, end, units, window)
           : add_block<D, B, false>(basis, grid, p, begin, end, units, window);
  });
}

}  // namespace sluice::mpm
