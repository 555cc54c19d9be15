#include "mpm/implicit/stencils.hpp"

#include <algorithm>
#include <cmath>

#include "mpm/shape/weights.hpp"
#include "mpm/step/solid_step.hpp"
#include "mpm/transfer/dispatch.hpp"

namespace sluice::mpm {
namespace {

constexpr double least_reach = 1e-12;

bool comes_before(IntVec3 a, IntVec3 b) {
  if (a.z != b.z) return a.z < b.z;
  return a.y != b.y ? a.y < b.y : a.x < b.x;
}

}  // namespace

ReachedNodes::ReachedNodes(const MpmScene& solids, const Level& level, const NodeBoundary& boundary,
                           const std::vector<Carried>& carried, const AllParticles& particles)
    : stencils_(particles.count()), raw_(particles.count()) {
  for (std::size_t k = 0; k < particles.count(); ++k)
    find_stencils(solids, level, carried[k], particles.kind(k).now, k);
  number(boundary);
  raw_.clear();
  list_entries();
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

// Numbers rise along x, then y, then z.
void ReachedNodes::number(const NodeBoundary& boundary) {
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
  for (const auto& nodes : raw_) at_.insert(at_.end(), nodes.begin(), nodes.end());
  std::sort(at_.begin(), at_.end(), comes_before);
  at_.erase(std::unique(at_.begin(), at_.end()), at_.end());
  for (std::size_t k = 0; k < raw_.size(); ++k)
    for (std::size_t e = 0; e < raw_[k].size(); ++e)
      stencils_[k].node[e] = static_cast<std::int32_t>(
          std::lower_bound(at_.begin(), at_.end(), raw_[k][e], comes_before) - at_.begin());
}

void ReachedNodes::list_entries() {
  begin_.assign(at_.size() + 1, 0);
  for (const Stencils& s : stencils_)
    for (const std::int32_t n : s.node) ++begin_[static_cast<std::size_t>(n) + 1];
  for (std::size_t n = 0; n < at_.size(); ++n) begin_[n + 1] += begin_[n];
  entries_.resize(begin_.back());
  std::vector<std::size_t> to(begin_.begin(), begin_.end() - 1);
  for (std::size_t k = 0; k < stencils_.size(); ++k) {
    const Stencils& s = stencils_[k];
    for (std::size_t e = 0; e < s.node.size(); ++e)
      entries_[to[static_cast<std::size_t>(s.node[e])]++] = {
          static_cast<std::uint32_t>(k),
          static_cast<std::uint32_t>(e / static_cast<std::size_t>(s.per)), e};
  }
}

}  // namespace sluice::mpm
