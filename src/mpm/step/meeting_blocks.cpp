#include "mpm/step/meeting_blocks.hpp"

#include <algorithm>

#include "mpm/nodes/node_sums.hpp"

namespace sluice::mpm {
namespace {

const Body& body_of(std::span<const Body> bodies, int m) {
  return bodies[static_cast<std::size_t>(m)];
}

bool share_a_node(std::span<const Body> bodies, BlockMember one, BlockMember other) {
  const auto counts = [&](BlockMember of) {
    return body_of(bodies, of.body).nodes.sums(of.block) + count_lane;
  };
  const std::int64_t *a = counts(one), *b = counts(other);
  for (int n = 0; n < block_lanes; n += lanes)
    if (a[n] != 0 && b[n] != 0) return true;
  return false;
}

}  // namespace

void BlockGroups::clear() {
  members_.clear();
  first_.clear();
}

void list_single_blocks(std::span<const Body> bodies, BlockGroups& groups) {
  groups.clear();
  for (std::size_t m = 0; m < bodies.size(); ++m) {
    if (bodies[m].material->rigid) continue;
    for (int b = 0; b < bodies[m].table.count(); ++b) {
      groups.begin_group();
      groups.add({static_cast<int>(m), b});
    }
  }
}

void MeetingBlocks::unite(std::span<Body> bodies) const {
  std::vector<IntVec3> all;
  for (std::size_t m = 0; m < bodies.size(); ++m)
    for (int b = 0; b < bodies[m].table.count() && contact_->takes(static_cast<int>(m)); ++b)
      all.push_back(bodies[m].table.block(b));
  for (std::size_t m = 0; m < bodies.size(); ++m) {
    Body& body = bodies[m];
    if (!contact_->takes(static_cast<int>(m))) continue;
    for (const IntVec3 block : all) body.table.find_or_add(block);
    body.nodes.fit(body.table);
  }
}

void MeetingBlocks::mark(BlockMember of) {
  marks_[static_cast<std::size_t>(of.body)][static_cast<std::size_t>(of.block)] = 1;
  any_ = true;
}

void MeetingBlocks::find(std::span<const Body> bodies) {
  any_ = false;
  const int count = static_cast<int>(bodies.size());
  marks_.resize(bodies.size());
  for (std::size_t m = 0; m < bodies.size(); ++m)
    marks_[m].assign(static_cast<std::size_t>(bodies[m].table.count()), 0);
  for (int m = 0; m < count; ++m) {
    const BlockTable& table = body_of(bodies, m).table;
    for (int b = 0; b < table.count() && contact_->takes(m); ++b) {
      const BlockMember own{m, b};
      if (contact_->leads(m) && share_a_node(bodies, own, own)) mark(own);
      for (int k = m + 1; k < count; ++k) {
        if (!contact_->takes(k)) continue;
        const BlockMember other{k, body_of(bodies, k).table.find(table.block(b))};
        if (other.block < 0 || !share_a_node(bodies, own, other)) continue;
        mark(own);
        mark(other);
      }
    }
  }
}

bool MeetingBlocks::meets(std::span<const BlockMember> members) const {
  return std::any_of(members.begin(), members.end(), [&](const BlockMember& b) {
    const std::vector<char>& of_body = marks_[static_cast<std::size_t>(b.body)];
    const auto block = static_cast<std::size_t>(b.block);  // others came later, without mass
    return contact_->takes(b.body) && block < of_body.size() && of_body[block] != 0;
  });
}

void MeetingBlocks::list_groups(std::span<const Body> bodies, BlockGroups& groups) const {
  groups.clear();
  const int count = static_cast<int>(bodies.size());
  const auto table = [&](int m) -> const BlockTable& { return body_of(bodies, m).table; };
  const auto meets = [&](int m) { return contact_->takes(m); };
  for (int m = 0; m < count; ++m) {
    if (!meets(m) && body_of(bodies, m).material->rigid) continue;
    for (int b = 0; b < table(m).count(); ++b) {
      const IntVec3 block = table(m).block(b);
      bool earlier = false;  // a body before it has listed the block
      for (int k = 0; k < m && meets(m) && !earlier; ++k)
        earlier = meets(k) && table(k).find(block) >= 0;
      if (earlier) continue;
      groups.begin_group();
      groups.add({m, b});
      for (int k = m + 1; k < count && meets(m); ++k) {
        const int other = meets(k) ? table(k).find(block) : -1;
        if (other >= 0) groups.add({k, other});
      }
    }
  }
}

}  // namespace sluice::mpm
