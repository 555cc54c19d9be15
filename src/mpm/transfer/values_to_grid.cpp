#include "mpm/transfer/values_to_grid.hpp"

#include <algorithm>

#include "mpm/nodes/node_sums.hpp"
#include "mpm/transfer/corner_transfer.hpp"
#include "mpm/transfer/dispatch.hpp"

namespace sluice::mpm {
namespace {

template <int D, class B>
void add_block(Basis basis, const TransferGrid& grid, const std::array<const double*, 3>& x,
               const ParticleShape& shape, std::span<const ValueLane> lanes_of, int begin, int end,
               Window& window) {
  constexpr int N = B::nodes;
  constexpr int rows = D > 1 ? N : 1, planes = D > 2 ? N : 1;
  alignas(64) static thread_local AxisWeights<N> w[D];
  const IntVec3 low = window.lower();
  for (int at = begin; at < end; at += chunk_size) {
    const int n = std::min(chunk_size, end - at);
    for (int a = 0; a < D; ++a)
      weights_of<B, false>(basis, grid, x, shape, grid.active[a], at, n, w[a]);
    for (int q = 0; q < n; ++q) {
      double values[lanes] = {};
      for (std::size_t l = 0; l < lanes_of.size(); ++l)
        values[l] = lanes_of[l].values[at + q] * lanes_of[l].unit;
      const Four first{values[0], values[1], values[2], values[3]};
      const Four second{values[4], values[5], values[6], 0.0};
      IntVec3 node{};
      for (int a = 0; a < D; ++a) {
        const int d = grid.active[a];
        node[d] = w[a].first[q] - low[d];
      }
      for (int k = 0; k < planes; ++k)
        for (int j = 0; j < rows; ++j) {
          double rest = D > 2 ? w[D - 1].w[k][q] : 1.0;
          if constexpr (D > 1) rest *= w[1].w[j][q];
          IntVec3 row = node;
          if constexpr (D > 1) row[grid.active[1]] += j;
          if constexpr (D > 2) row[grid.active[2]] += k;
          std::int64_t* to = window.at(row.x, row.y, row.z);
          for (int i = 0; i < N; ++i, to += lanes) {
            const double s = w[0].w[i][q] * rest;
            add_rounded(to, first * s);
            add_rounded(to + 4, second * s);
          }
        }
    }
  }
}

}  // namespace

void add_values_to_window(Basis basis, const TransferGrid& grid,
                          const std::array<const double*, 3>& x, const ParticleShape& shape,
                          std::span<const ValueLane> lanes_of, int begin, int end, Window& window) {
  if (by_corners(basis))
    return add_values_of_corners(basis, grid, x, shape, lanes_of, begin, end, window);
  for_basis(basis, has_own_widths(basis, shape), grid.count, [&]<int D, class B>() {
    add_block<D, B>(basis, grid, x, shape, lanes_of, begin, end, window);
  });
}

}  // namespace sluice::mpm
