#include "mpm/implicit/node_pairs.hpp"

#include <algorithm>
#include <cmath>

namespace sluice::mpm {
namespace {

// Nodes of a particle along one direction, less one.
int reach_of(const NodesOfStep::Parts& parts, bool triples) {
  int dimensions = 0, reach = triples ? 2 : 1;
  for (const bool active : parts.level->active) dimensions += active ? 1 : 0;
  for (std::size_t k = 0; k < parts.reached->kinds(); ++k) {
    const int per = parts.reached->of(k).per;
    if (per == 0) continue;
    reach = std::max(reach, static_cast<int>(std::lround(std::pow(per, 1.0 / dimensions))) - 1);
  }
  return reach;
}

}  // namespace

solve::Workers workers_of(const ThreadTeam& team) {
  return {team.size(), [&team](std::size_t pieces, const solve::Workers::Work& work) {
            team.for_each(pieces, work);
          }};
}

NodePairs::NodePairs(const NodesOfStep::Parts& parts, Which which, const solve::Workers& workers)
    : reached_(parts.reached), reach_(reach_of(parts, which.triples)) {
  const std::size_t n = parts.reached->count();
  IntVec3 low = IntVec3::all(0);
  if (n > 0) low = parts.reached->index(0);
  for (std::size_t i = 0; i < n; ++i) low = min(low, parts.reached->index(i));
  IntVec3 stride, width;
  for (int d = 0; d < 3; ++d) {
    const auto axis = static_cast<std::size_t>(d);
    width[d] = parts.level->active[axis] ? 2 * reach_ + 1 : 1;
    if (!parts.level->active[axis] || !parts.level->periodic[axis]) continue;
    period_[d] = parts.level->domain.upper[d] - parts.level->domain.lower[d];
    wraps_ = true;
  }
  stride = {1, width.x, width.x * width.y};
  offsets_ = static_cast<std::size_t>(width.x * width.y * width.z);
  middle_ = static_cast<int>(offsets_ / 2);
  at_.resize(n);
  line_.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    at_[i] = parts.reached->index(i) - low;
    line_[i] = at_[i].x * stride.x + at_[i].y * stride.y + at_[i].z * stride.z;
  }
  slot_.assign(n * offsets_, -1);
  const std::size_t pieces = workers.count == 1 ? 1 : 4 * static_cast<std::size_t>(workers.count);
  workers.run(pieces, [&](std::size_t piece, int) {
    mark_pairs(parts, which.with_rigid, piece * n / pieces, (piece + 1) * n / pieces);
  });
}

// Rows of nodes first, ..., end - 1.
void NodePairs::mark_pairs(const NodesOfStep::Parts& parts, bool with_rigid, std::size_t first,
                           std::size_t end) {
  for (std::size_t i = first; i < end; ++i)
    slot_[entry(static_cast<std::int32_t>(i), static_cast<std::int32_t>(i))] = 0;
  std::vector<std::int32_t> nodes;
  for (std::size_t k = 0; k < parts.reached->kinds(); ++k) {
    if (parts.solids->materials[k].rigid && !with_rigid) continue;
    const Stencils& s = parts.reached->of(k);
    for (std::size_t p = 0; p < parts.particles->kind(k).now.size(); ++p) {
      nodes.clear();
      for (std::size_t e = s.first(p); e < s.first(p + 1); ++e)
        if (s.acts(e)) nodes.push_back(s.node[e]);
      for (const std::int32_t i : nodes) {
        if (static_cast<std::size_t>(i) < first || static_cast<std::size_t>(i) >= end) continue;
        for (const std::int32_t j : nodes) slot_[entry(i, j)] = 0;
      }
    }
  }
}

std::size_t NodePairs::wrapped_entry(std::int32_t i, std::int32_t j) const {
  IntVec3 offset = at_[static_cast<std::size_t>(j)] - at_[static_cast<std::size_t>(i)];
  std::size_t at = 0, stride = 1;
  for (int d = 0; d < 3; ++d) {
    const int period = period_[d];
    if (period > 0 && offset[d] > period / 2) offset[d] -= period;
    if (period > 0 && offset[d] < -((period - 1) / 2)) offset[d] += period;
    if (!reached_->active(d)) continue;
    at += stride * static_cast<std::size_t>(offset[d] + reach_);
    stride *= static_cast<std::size_t>(2 * reach_ + 1);
  }
  return static_cast<std::size_t>(i) * offsets_ + at;
}

void NodePairs::add(std::span<const NodeTriple> triples) {
  for (const NodeTriple& t : triples)
    for (const std::int32_t i : t)
      for (const std::int32_t j : t) slot_[entry(i, j)] = 0;
}

solve::BlockRows NodePairs::number(int width) {
  solve::BlockRows rows;
  rows.width = width;
  rows.place = at_;
  rows.begin.assign(1, 0);
  const IntVec3 low = at_.empty() ? IntVec3{} : reached_->index(0) - at_[0];
  IntVec3 reach;
  for (int d = 0; d < 3; ++d) reach[d] = reached_->active(d) ? reach_ : 0;
  std::vector<std::pair<std::int32_t, std::size_t>> found;
  for (std::size_t i = 0; i < at_.size(); ++i) {
    found.clear();
    std::size_t at = i * offsets_;
    for (int z = -reach.z; z <= reach.z; ++z)
      for (int y = -reach.y; y <= reach.y; ++y)
        for (int x = -reach.x; x <= reach.x; ++x, ++at) {
          if (slot_[at] < 0) continue;
          IntVec3 other = at_[i] + low + IntVec3{x, y, z};
          if (wraps_) other = reached_->wrap(other);
          found.emplace_back(reached_->find(other), at);
        }
    if (wraps_) std::sort(found.begin(), found.end());
    for (std::size_t n = 0; n < found.size(); ++n) {
      slot_[found[n].second] = static_cast<std::int16_t>(n);
      rows.column.push_back(found[n].first);
    }
    rows.begin.push_back(rows.column.size());
  }
  rows.value.assign(rows.column.size() * static_cast<std::size_t>(width * width), 0.0);
  return rows;
}

}  // namespace sluice::mpm
