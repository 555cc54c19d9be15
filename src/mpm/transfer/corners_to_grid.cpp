// Particles with corners to the grid.
#include <algorithm>

#include "mpm/nodes/node_sums.hpp"
#include "mpm/transfer/corner_transfer.hpp"
#include "mpm/transfer/corners.hpp"
#include "mpm/transfer/gifts.hpp"
#include "mpm/transfer/window_axes.hpp"

namespace sluice::mpm {
namespace {

template <int D, bool Tetrahedron, bool Affine, bool Forces>
void add_particle(const NodalContribution& g, const Corners<D, Tetrahedron>& corners, int q,
                  const TransferGrid& grid, const WindowAxes<D>& axes, std::int64_t* nodes) {
  constexpr double share = Corners<D, Tetrahedron>::share;
  const Four load = g.load * share, mass = g.mass_momentum * share;
  Four affine[D]{};
  if constexpr (Affine)
    for (int a = 0; a < D; ++a) {
      const std::size_t d = grid.active[a];
      affine[a] = g.affine[a] * (share * grid.axes[d].spacing);
    }
  for (int c = 0; c < corners.count; ++c) {
    Four force = load, momentum = mass;
    double w[D][2];
    std::int64_t* node = nodes;
    for (int a = 0; a < D; ++a) {
      const double s = corners.s[c][a][q];
      w[a][0] = 0.5 - s;
      w[a][1] = 0.5 + s;
      if constexpr (Forces) force += g.traction[a] * corners.slope[c][a][q];
      // x_i - x_p = (x_c - x_p) - s -+ 1/2, in cells.
      if constexpr (Affine) momentum += affine[a] * (corners.way[c][a][q] - s);
      node += (corners.first[c][a][q] - axes.low[a]) * axes.stride[a];
    }
    for (int i = 0; i < 1 << D; ++i) {
      double weight = w[0][i & 1];
      std::int64_t* to = node + (i & 1) * axes.stride[0];
      Four given = momentum;
      if constexpr (Affine) given += affine[0] * (i & 1 ? 0.5 : -0.5);
      for (int a = 1; a < D; ++a) {
        weight *= w[a][i >> a & 1];
        to += (i >> a & 1) * axes.stride[a];
        if constexpr (Affine) given += affine[a] * (i >> a & 1 ? 0.5 : -0.5);
      }
      add_rounded(to, given * weight);
      if constexpr (Forces)
        add_rounded(to + 4, force * weight);
      else
        to[count_lane] = wrapped_sum(to[count_lane], rounding_bits);
    }
  }
}

template <int D, bool Tetrahedron, bool Affine, bool Forces>
void add_block(const TransferGrid& grid, const ParticlesToGrid& p, int begin, int end,
               const SumUnits& units, Window& window) {
  static thread_local Corners<D, Tetrahedron> corners;
  static thread_local NodalContribution gifts[chunk_size];
  const WindowAxes<D> axes(grid, window);
  std::int64_t* nodes = window.at(0, 0, 0);
  for (int at = begin; at < end; at += chunk_size) {
    const int n = std::min(chunk_size, end - at);
    find_corners(grid, p.x, p.shape, at, n, Forces ? Slopes::wanted : Slopes::unused, corners);
    nodal_contributions(grid, p, at, n, units, gifts);
    for (int q = 0; q < n; ++q)
      add_particle<D, Tetrahedron, Affine, Forces>(gifts[q], corners, q, grid, axes, nodes);
  }
}

template <int D, bool Tetrahedron>
void add_values(const TransferGrid& grid, const std::array<const double*, 3>& x,
                const ParticleShape& shape, std::span<const ValueLane> lanes_of, int begin, int end,
                Window& window) {
  static thread_local Corners<D, Tetrahedron> corners;
  for (int at = begin; at < end; at += chunk_size) {
    const int n = std::min(chunk_size, end - at);
    find_corners(grid, x, shape, at, n, Slopes::unused, corners);
    for (int q = 0; q < n; ++q) {
      double values[lanes] = {};
      for (std::size_t l = 0; l < lanes_of.size(); ++l)
        values[l] = lanes_of[l].values[at + q] * lanes_of[l].unit * corners.share;
      const Four first{values[0], values[1], values[2], values[3]};
      const Four second{values[4], values[5], values[6], 0.0};
      for (int c = 0; c < corners.count; ++c)
        for (int i = 0; i < 1 << D; ++i) {
          double weight = 1;
          IntVec3 node{};
          for (int a = 0; a < D; ++a) {
            const int d = grid.active[a];
            const int up = i >> a & 1;
            weight *= up ? 0.5 + corners.s[c][a][q] : 0.5 - corners.s[c][a][q];
            node[d] = corners.first[c][a][q] + up - window.lower()[d];
          }
          std::int64_t* to = window.at(node.x, node.y, node.z);
          add_rounded(to, first * weight);
          add_rounded(to + 4, second * weight);
        }
    }
  }
}

}  // namespace

void add_corners(Basis basis, const TransferGrid& grid, const ParticlesToGrid& p, int begin,
                 int end, const SumUnits& units, Window& window) {
  const auto add = [&]<int D, bool Tetrahedron>() {
    const auto with = [&]<bool Affine>() {
      p.volume != nullptr || p.load[0] != nullptr
          ? add_block<D, Tetrahedron, Affine, true>(grid, p, begin, end, units, window)
          : add_block<D, Tetrahedron, Affine, false>(grid, p, begin, end, units, window);
    };
    p.varies() ? with.template operator()<true>() : with.template operator()<false>();
  };
  if (basis == Basis::cpti) return add.template operator()<3, true>();
  if (grid.count == 3) return add.template operator()<3, false>();
  if (grid.count == 2) return add.template operator()<2, false>();
  add.template operator()<1, false>();
}

void add_values_of_corners(Basis basis, const TransferGrid& grid,
                           const std::array<const double*, 3>& x, const ParticleShape& shape,
                           std::span<const ValueLane> lanes_of, int begin, int end,
                           Window& window) {
  if (basis == Basis::cpti)
    return add_values<3, true>(grid, x, shape, lanes_of, begin, end, window);
  if (grid.count == 3) return add_values<3, false>(grid, x, shape, lanes_of, begin, end, window);
  if (grid.count == 2) return add_values<2, false>(grid, x, shape, lanes_of, begin, end, window);
  add_values<1, false>(grid, x, shape, lanes_of, begin, end, window);
}

}  // namespace sluice::mpm
