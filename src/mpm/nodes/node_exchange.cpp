#include "mpm/nodes/node_exchange.hpp"

#include <algorithm>
#include <bit>
#include <cstring>
#include <set>

#include "framework/grid/grid_boxes.hpp"
#include "mpm/nodes/node_sums.hpp"

namespace sluice::mpm {
namespace {

constexpr int count_tag = 51, block_tag = 52, sum_tag = 53, total_tag = 54;
// Layers of blocks around a box in which its particles may reach nodes, and by which the home of a
// block may lie beside it.
constexpr int block_layers = 3;

// The box grown by some layers, and its images across periodic sides.
std::vector<IndexBox> images_of(const Level& level, IndexBox box, IntVec3 layers) {
  box.lower -= layers;
  box.upper += layers;
  std::vector<IndexBox> all;
  const IntVec3 size = level.domain.size();
  const auto shifts = [&](int d) { return level.periodic[d] ? 1 : 0; };
  for (int k = -shifts(2); k <= shifts(2); ++k)
    for (int j = -shifts(1); j <= shifts(1); ++j)
      for (int i = -shifts(0); i <= shifts(0); ++i) {
        const IntVec3 by = IntVec3{i, j, k} * size;
        all.push_back({box.lower + by, box.upper + by});
      }
  return all;
}

double as_number(IntVec3 block) {  // 21 bits a direction, as bits
  const auto part = [](int i) { return static_cast<std::uint64_t>(i) & 0x1fffff; };
  return std::bit_cast<double>(part(block.x) | part(block.y) << 21 | part(block.z) << 42);
}

IntVec3 as_block(double number) {
  const auto bits = std::bit_cast<std::uint64_t>(number);
  const auto part = [&](int shift) {
    const auto raw = static_cast<std::int32_t>((bits >> shift) & 0x1fffff);
    return raw >= 0x100000 ? raw - 0x200000 : raw;
  };
  return {part(0), part(21), part(42)};
}

void pack(const BlockTable& table, int block, std::span<NodeLanes* const> groups,
          std::vector<double>& to) {
  to.push_back(as_number(table.block(block)));
  const std::size_t at = to.size();
  to.resize(at + groups.size() * block_lanes);
  for (std::size_t g = 0; g < groups.size(); ++g)
    std::memcpy(to.data() + at + g * block_lanes, groups[g]->sums(block),
                block_lanes * sizeof(std::int64_t));
}

}  // namespace

NodeExchange::NodeExchange(const Level& level, Communicator& ranks, bool everywhere)
    : level_(level), ranks_(&ranks), everywhere_(everywhere), finder_(cells_of(level.boxes)) {
  number_.assign(ranks.size(), -1);
  if (ranks.size() == 1) return;
  const BlockShape shape = block_shape(level.active);
  IntVec3 layers{};
  for (int d = 0; d < 3; ++d)
    if (shape.edge[d] > 1) layers[d] = block_layers * shape.edge[d];
  std::set<int> found;
  for (int r = 0; everywhere && r < ranks.size(); ++r) found.insert(r);
  for (const GridBox& mine : level.boxes) {
    if (mine.owner != ranks.rank()) continue;
    for (const IndexBox& near : images_of(level, mine.cells, layers))
      for (const int n : finder_.overlapping(near)) found.insert(level.boxes[n].owner);
  }
  found.erase(ranks.rank());
  neighbours_.assign(found.begin(), found.end());
  for (std::size_t n = 0; n < neighbours_.size(); ++n)
    number_[neighbours_[n]] = static_cast<int>(n);
}

bool NodeExchange::fits(const Level& level, bool everywhere) const {
  if (everywhere && !everywhere_) return false;
  return same_boxes(level.boxes, level_.boxes);
}

int NodeExchange::home(const BlockShape& shape, IntVec3 block) const {
  IntVec3 cell = shape.lower(block);
  for (int d = 0; d < 3; ++d) {
    cell[d] += shape.edge[d] / 2;
    cell[d] = std::min(std::max(cell[d], level_.domain.lower[d]), level_.domain.upper[d] - 1);
  }
  IndexBox around{cell, cell + IntVec3{1, 1, 1}};
  for (int grown = 0; grown < block_layers; ++grown) {
    const std::vector<int> found = finder_.overlapping(around);
    if (!found.empty()) return level_.boxes[found.front()].owner;
    around.lower -= shape.edge;
    around.upper += shape.edge;
  }
  return 0;
}

NodeExchange::Buffers NodeExchange::swap(const Buffers& out) {
  const std::size_t count = neighbours_.size();
  Buffers in(count);
  std::vector<double> sizes_in(count), sizes_out(count);
  Messages messages;
  for (std::size_t n = 0; n < count; ++n)
    messages.post_receive(&sizes_in[n], 1, neighbours_[n], count_tag);
  for (std::size_t n = 0; n < count; ++n) {
    sizes_out[n] = static_cast<double>(out[n].size());
    messages.post_send(&sizes_out[n], 1, neighbours_[n], count_tag);
  }
  messages.wait_all();
  for (std::size_t n = 0; n < count; ++n) {
    in[n].resize(static_cast<std::size_t>(sizes_in[n]));
    if (!in[n].empty())
      messages.post_receive(in[n].data(), in[n].size(), neighbours_[n], block_tag);
  }
  for (std::size_t n = 0; n < count; ++n)
    if (!out[n].empty())
      messages.post_send(out[n].data(), out[n].size(), neighbours_[n], block_tag);
  messages.wait_all();
  return in;
}

SharedBlocks NodeExchange::share(BlockTable& table, std::span<NodeLanes* const> groups) {
  SharedBlocks blocks;
  if (ranks_->size() == 1 || groups.empty()) return blocks;
  blocks.sent.resize(neighbours_.size());
  blocks.arrived.resize(neighbours_.size());
  const std::size_t entry = 1 + groups.size() * block_lanes;
  Buffers out(neighbours_.size());
  for (int b = 0; b < table.count(); ++b) {
    const int to = home(table.shape(), table.block(b));
    if (to == ranks_->rank()) continue;
    pack(table, b, groups, out[number_[to]]);
    blocks.sent[number_[to]].push_back(table.block(b));
  }
  const Buffers arrived = swap(out);
  for (std::size_t n = 0; n < arrived.size(); ++n)
    for (std::size_t at = 0; at < arrived[n].size(); at += entry) {
      const std::vector<double>& from = arrived[n];
      blocks.arrived[n].push_back(as_block(from[at]));
      const int b = table.find_or_add(blocks.arrived[n].back());
      for (std::size_t g = 0; g < groups.size(); ++g) {
        groups[g]->fit(table);
        std::int64_t* sums = groups[g]->sums(b);
        const double* values = from.data() + at + 1 + g * block_lanes;
        for (int l = 0; l < block_lanes; ++l)
          sums[l] = wrapped_sum(sums[l], std::bit_cast<std::int64_t>(values[l]));
      }
    }
  Buffers totals(neighbours_.size());
  for (std::size_t n = 0; n < arrived.size(); ++n)
    for (std::size_t at = 0; at < arrived[n].size(); at += entry)
      pack(table, table.find(as_block(arrived[n][at])), groups, totals[n]);
  for (const std::vector<double>& from : swap(totals))
    for (std::size_t at = 0; at < from.size(); at += entry) {
      const int b = table.find(as_block(from[at]));
      for (std::size_t g = 0; g < groups.size(); ++g)
        std::memcpy(groups[g]->sums(b), from.data() + at + 1 + g * block_lanes,
                    block_lanes * sizeof(std::int64_t));
    }
  return blocks;
}

namespace {

// The lanes of those of some blocks that are wanted, one after the other.
std::vector<double> wanted_lanes(const BlockTable& table, const NodeLanes& group,
                                 const std::vector<IntVec3>& blocks,
                                 const std::vector<char>& wanted) {
  std::vector<double> all;
  for (const IntVec3 block : blocks) {
    const int b = table.find(block);
    if (!wanted[b]) continue;
    all.resize(all.size() + block_lanes);
    std::memcpy(all.data() + all.size() - block_lanes, group.sums(b),
                block_lanes * sizeof(std::int64_t));
  }
  return all;
}

// act(lanes of a block, those that came for it).
template <class Act>
void for_each_wanted(const BlockTable& table, NodeLanes& group, const std::vector<IntVec3>& blocks,
                     const std::vector<char>& wanted, const std::vector<double>& from, Act&& act) {
  const double* values = from.data();
  for (const IntVec3 block : blocks) {
    const int b = table.find(block);
    if (!wanted[b]) continue;
    act(group.sums(b), values);
    values += block_lanes;
  }
}

}  // namespace

// Both sides know how many numbers go between them: no counts are sent.
NodeExchange::Buffers NodeExchange::pass(int tag, const Buffers& out,
                                         std::span<const std::size_t> sizes_in) {
  Buffers in(out.size());
  Messages messages;
  for (std::size_t n = 0; n < in.size(); ++n) {
    if (sizes_in[n] == 0) continue;
    in[n].resize(sizes_in[n]);
    messages.post_receive(in[n].data(), in[n].size(), neighbours_[n], tag);
  }
  for (std::size_t n = 0; n < out.size(); ++n)
    if (!out[n].empty()) messages.post_send(out[n].data(), out[n].size(), neighbours_[n], tag);
  messages.wait_all();
  return in;
}

void NodeExchange::share_some(const BlockTable& table, NodeLanes& group, const SharedBlocks& blocks,
                              const std::vector<char>& wanted) {
  const std::size_t count = blocks.sent.size();
  Buffers out(count), totals(count);
  std::vector<std::size_t> sent(count), arriving(count);
  for (std::size_t n = 0; n < count; ++n) {
    out[n] = wanted_lanes(table, group, blocks.sent[n], wanted);
    sent[n] = out[n].size();
    for (const IntVec3 block : blocks.arrived[n])
      if (wanted[table.find(block)]) arriving[n] += block_lanes;
  }
  const Buffers arrived = pass(sum_tag, out, arriving);
  for (std::size_t n = 0; n < count; ++n)
    for_each_wanted(table, group, blocks.arrived[n], wanted, arrived[n],
                    [](std::int64_t* sums, const double* values) {
                      for (int l = 0; l < block_lanes; ++l)
                        sums[l] = wrapped_sum(sums[l], std::bit_cast<std::int64_t>(values[l]));
                    });
  for (std::size_t n = 0; n < count; ++n)
    totals[n] = wanted_lanes(table, group, blocks.arrived[n], wanted);
  const Buffers back = pass(total_tag, totals, sent);
  for (std::size_t n = 0; n < count; ++n)
    for_each_wanted(table, group, blocks.sent[n], wanted, back[n],
                    [](std::int64_t* sums, const double* values) {
                      std::memcpy(sums, values, block_lanes * sizeof(std::int64_t));
                    });
}

}  // namespace sluice::mpm
