#include "mpm/implicit/stencils.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mpm/shape/weights.hpp"
#include "mpm/step/body.hpp"
#include "mpm/transfer/dispatch.hpp"

namespace sluice::mpm {
namespace {

constexpr double least_reach = 1e-12;

}  // namespace

ReachedNodes::ReachedNodes(const MpmScene& solids, const Level& level, const NodeBoundary& boundary,
                           const std::vector<Carried>& carried, const AllParticles& particles)
    : stencils_(particles.count()),
      raw_(particles.count()),
      domain_(level.domain),
      active_(level.active),
      periodic_(level.periodic) {
  for (std::size_t k = 0; k < particles.count(); ++k)
    find_stencils(solids, level, carried[k], particles.kind(k).now, k);
  replace_images(boundary);
  number();
  raw_.clear();
}

void ReachedNodes::find_stencils(const MpmScene& solids, const Level& level, const Carried& carried,
                                 const ParticleSet& set, std::size_t kind) {
  const TransferGrid grid = transfer_grid(solids, level, carried.half);
  const auto x = places_of(set, carried.columns);
  const ParticleShape shape = shape_of(set, carried.columns);
  Stencils& s = stencils_[kind];
  for_basis(solids.basis, has_own_widths(solids.basis, shape), grid.count, [&]<int D, class B>() {
    constexpr int N = B::nodes;
    s.per = D == 3 ? N * N * N : D == 2 ? N * N : N;
    const std::size_t entries = s.first(set.size());
    s.node.resize(entries);
    s.flipped.resize(entries);
    s.weight.resize(entries);
    s.slope.resize(entries);
    raw_[kind].resize(entries);
    std::vector<AxisWeights<N>> w(D);
    for (std::size_t at = 0; at < set.size(); at += chunk_size) {
      const int n = static_cast<int>(std::min<std::size_t>(chunk_size, set.size() - at));
      for (std::size_t a = 0; a < D; ++a)
        weights_of<B, false>(solids.basis, grid, x, shape, grid.active[a], static_cast<int>(at), n,
                             w[a]);
      for (int q = 0; q < n; ++q)
        for (int e = 0; e < s.per; ++e) {
          const std::size_t entry =
              s.first(at + static_cast<std::size_t>(q)) + static_cast<std::size_t>(e);
          const int i[3] = {e % N, e / N % N, e / (N * N)};
          IntVec3 node = level.domain.lower;
          std::array<double, 3> slope{};
          double weight = 1;
          for (int a = 0; a < D; ++a) {
            const auto axis = static_cast<std::size_t>(a);
            const int d = grid.active[axis];
            node[d] = w[axis].first[q] + i[a];
            weight *= w[axis].w[i[a]][q];
            double product = 1;
            for (int b = 0; b < D; ++b)
              product *= b == a ? w[axis].d[i[a]][q] : w[static_cast<std::size_t>(b)].w[i[b]][q];
            slope[static_cast<std::size_t>(d)] = product;
          }
          // A particle whose edge lies on a line of nodes reaches the next by round-off alone.
          double reach = std::fabs(weight);
          for (int d = 0; d < 3; ++d)
            reach =
                std::max(reach, std::fabs(slope[static_cast<std::size_t>(d)]) * level.spacing[d]);
          raw_[kind][entry] = node;
          s.weight[entry] = reach < least_reach ? 0 : weight;
          s.slope[entry] = reach < least_reach ? std::array<double, 3>{} : slope;
        }
    }
  });
}

IntVec3 ReachedNodes::wrap(IntVec3 index) const {
  for (int d = 0; d < 3; ++d) {
    if (!active(d) || !periodic_[static_cast<std::size_t>(d)]) continue;
    const int period = domain_.upper[d] - domain_.lower[d];
    while (index[d] < domain_.lower[d]) index[d] += period;
    while (index[d] >= domain_.upper[d]) index[d] -= period;
  }
  return index;
}

void ReachedNodes::replace_images(const NodeBoundary& boundary) {
  for (std::size_t k = 0; k < raw_.size(); ++k)
    for (std::size_t e = 0; e < raw_[k].size(); ++e) {
      const int material = static_cast<int>(k);
      if (!boundary.is_image(raw_[k][e], material)) continue;
      const NodeBoundary::Image image = boundary.image(raw_[k][e], material);
      raw_[k][e] = image.of;
      for (int d = 0; d < 3; ++d)
        if (image.flipped[static_cast<std::size_t>(d)])
          stencils_[k].flipped[e] = static_cast<std::uint8_t>(stencils_[k].flipped[e] | 1 << d);
    }
}

// Numbers rise along x, then y, then z.
void ReachedNodes::number() {
  IntVec3 low = IntVec3::all(std::numeric_limits<int>::max()), high = IntVec3::all(-1);
  for (std::size_t k = 0; k < raw_.size(); ++k)
    for (const IntVec3 i : raw_[k]) {
      low = min(low, i);
      high = max(high, i);
    }
  for (int d = 0; d < 3; ++d)
    if (low[d] > high[d]) return;  // no particle
  numbers_ = solve::NodeNumbers(low, high + IntVec3::all(1));
  for (std::size_t k = 0; k < raw_.size(); ++k)
    for (std::size_t e = 0; e < raw_[k].size(); ++e)
      if (stencils_[k].acts(e)) numbers_.mark(raw_[k][e]);
  at_ = numbers_.number();
  for (std::size_t k = 0; k < raw_.size(); ++k) {
    Stencils& s = stencils_[k];
    for (std::size_t first = 0; first < raw_[k].size(); first += static_cast<std::size_t>(s.per)) {
      std::int32_t any = -1;
      const std::size_t end = first + static_cast<std::size_t>(s.per);
      for (std::size_t e = first; e < end; ++e)
        if (s.acts(e)) any = s.node[e] = numbers_(raw_[k][e]);
      for (std::size_t e = first; e < end; ++e)
        if (!s.acts(e)) s.node[e] = any;
    }
  }
}

}  // namespace sluice::mpm
