#include "mpm/contact/surface_sums.hpp"

#include <algorithm>
#include <cmath>

#include "mpm/nodes/node_sums.hpp"
#include "mpm/shape/weights.hpp"

namespace sluice::mpm {
namespace {

constexpr int reached = Gimp::nodes;

template <int D>
using Weights = AxisWeights<reached>[D];

// Lanes of a row of nodes along the first axis: head w + slope dS | tail w + pull (x_i - x_p) w.
struct Row {
  Four head{}, slope{}, tail{}, pull{};
};

template <int D>
void add_particle(double v, const Weights<D>& w, int q, const TransferGrid& grid,
                  const SurfaceUnits& u, Window& window) {
  IntVec3 first{};
  for (int a = 0; a < D; ++a) {
    const int d = grid.active[a];
    first[d] = w[a].first[q] - window.lower()[d];
  }
  const double vg = v * u.gradient, vp = -(v * u.place);
  for (int k = 0; k < (D > 2 ? reached : 1); ++k) {
    const double wz = D > 2 ? w[D - 1].w[k][q] : 1.0;
    for (int j = 0; j < (D > 1 ? reached : 1); ++j) {
      const double wy = D > 1 ? w[D > 1 ? 1 : 0].w[j][q] : 1.0, wyz = wy * wz;
      Row row;
      row.head[0] = v * u.volume * wyz;
      row.slope[1 + grid.active[0]] = vg * wyz;
      row.pull[grid.active[0]] = vp * wyz;
      if constexpr (D > 1) {
        row.head[1 + grid.active[1]] = vg * (w[1].d[j][q] * wz);
        row.tail[grid.active[1]] = vp * (w[1].off[j][q] * wyz);
      }
      if constexpr (D > 2) {
        row.head[1 + grid.active[2]] = vg * (wy * w[2].d[k][q]);
        row.tail[grid.active[2]] = vp * (w[2].off[k][q] * wyz);
      }
      IntVec3 at = first;
      if constexpr (D > 1) at[grid.active[1]] += j;
      if constexpr (D > 2) at[grid.active[2]] += k;
      std::int64_t* node = window.at(at.x, at.y, at.z);
      for (int i = 0; i < reached; ++i, node += lanes) {
        const double wx = w[0].w[i][q];
        add_rounded(node, row.head * wx + row.slope * w[0].d[i][q]);
        add_rounded(node + 4, row.tail * wx + row.pull * (w[0].off[i][q] * wx));
      }
    }
  }
}

template <int D>
void add_all(const TransferGrid& grid, const std::array<const double*, 3>& x, const double* volume,
             int begin, int end, const SurfaceUnits& units, Window& window) {
  alignas(64) static thread_local Weights<D> weights;
  for (int at = begin; at < end; at += chunk_size) {
    const int n = std::min(chunk_size, end - at);
    for (int a = 0; a < D; ++a) {
      const std::size_t d = grid.active[a];
      Gimp::weights<true>(grid.axes[d], x[d] + at, grid.half[d], n, weights[a]);
    }
    for (int q = 0; q < n; ++q)
      add_particle<D>(std::min(volume[at + q], units.max_volume), weights, q, grid, units, window);
  }
}

}  // namespace

SurfaceUnits surface_units(const Level& level, bool axisymmetric) {
  SurfaceUnits u;
  u.max_volume = 1;
  double steepest = 0, widest = 0;
  for (int d = 0; d < 3; ++d) {
    if (level.active[d]) {
      u.max_volume *= 2 * level.spacing[d];
      steepest = std::max(steepest, 1 / level.spacing[d]);
      widest = std::max(widest, level.spacing[d]);
    } else {
      u.max_volume *= level.spacing[d];
    }
  }
  // Volumes of one radian: times the radius.
  if (axisymmetric)
    u.max_volume *= std::max(1.0, level.anchor.x + level.domain.upper.x * level.spacing.x);
  u.volume = scale_for(u.max_volume);
  u.gradient = scale_for(u.max_volume * steepest);
  u.place = scale_for(u.max_volume * 2 * widest);
  return u;
}

void add_surfaces(const TransferGrid& grid, const std::array<const double*, 3>& x,
                  const double* volume, int begin, int end, const SurfaceUnits& units,
                  Window& window) {
  if (grid.count == 3) add_all<3>(grid, x, volume, begin, end, units, window);
  if (grid.count == 2) add_all<2>(grid, x, volume, begin, end, units, window);
  if (grid.count == 1) add_all<1>(grid, x, volume, begin, end, units, window);
}

SurfaceAtNode surface_at(const std::int64_t* node, const SurfaceUnits& units) {
  SurfaceAtNode s;
  if (node[count_lane] == 0) return s;
  const double volume = sum_in(node, 0);
  if (!(volume > 0)) return s;
  s.volume = volume / units.volume;
  for (int d = 0; d < 3; ++d) {
    s.gradient[d] = sum_in(node, 1 + d) / units.gradient;
    s.place[d] = sum_in(node, 4 + d) / units.place / s.volume;
  }
  return s;
}

}  // namespace sluice::mpm
