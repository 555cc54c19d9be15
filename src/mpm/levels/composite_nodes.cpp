#include "mpm/levels/composite_nodes.hpp"

#include <cmath>

#include "mpm/nodes/node_sums.hpp"

namespace sluice::mpm {
namespace {

int floor_ratio(int i, int r) {
  return i >= 0 ? i / r : -((-i + r - 1) / r);
}

// The coarse nodes around a fine one, with their weights: act(node, weight).
template <class Act>
void for_each_parent(IntVec3 fine, IntVec3 ratio, Act&& act) {
  IntVec3 low, rest;
  for (int d = 0; d < 3; ++d) {
    low[d] = floor_ratio(fine[d], ratio[d]);
    rest[d] = fine[d] - low[d] * ratio[d];
  }
  for (int c = 0; c < 8; ++c) {
    double weight = 1;
    IntVec3 node = low;
    for (int d = 0; d < 3; ++d) {
      const double share = static_cast<double>(rest[d]) / ratio[d];
      const bool up = (c >> d & 1) != 0;
      weight *= up ? share : 1 - share;
      node[d] += up ? 1 : 0;
    }
    if (weight > 0) act(node, weight);
  }
}

template <class Table, class Lanes>
auto* lanes_at(const Table& table, Lanes& nodes, IntVec3 node) {
  const int block = table.find(table.shape().block_of(node));
  return block < 0 ? nullptr : nodes.sums(block) + table.shape().place(node) * lanes;
}

}  // namespace

void CompositeNodes::to_fine(BlockTable& coarse, NodeLanes& coarse_nodes, BlockTable& fine,
                             NodeLanes& fine_nodes) const {
  const BlockShape& shape = coarse.shape();
  for (int b = 0; b < coarse.count(); ++b) {
    const IntVec3 low = shape.lower(coarse.block(b));
    if (!region_.meets_coarse(low, low + shape.edge)) continue;
    for_each_node(shape, low, [&](int n, IntVec3 node) {
      std::int64_t* from = coarse_nodes.sums(b) + n * lanes;
      const IntVec3 at = node * ratio_;
      if (from[count_lane] == 0 || !region_.inside(at)) return;
      const int block = fine.find_or_add(shape.block_of(at));
      fine_nodes.fit(fine);
      std::int64_t* to = fine_nodes.sums(block) + shape.place(at) * lanes;
      for (int l = 0; l < lanes; ++l) {
        to[l] = wrapped_sum(to[l], from[l]);
        from[l] = 0;
      }
    });
  }
}

void CompositeNodes::add_parents(const BlockTable& fine, const NodeLanes& fine_nodes,
                                 BlockTable& coarse, NodeLanes& coarse_nodes) const {
  const BlockShape& shape = fine.shape();
  for (int b = 0; b < fine.count(); ++b) {
    const IntVec3 low = shape.lower(fine.block(b));
    if (region_.all_inside(low, low + shape.edge)) continue;
    for_each_node(shape, low, [&](int n, IntVec3 node) {
      if (fine_nodes.sums(b)[n * lanes + count_lane] == 0 || region_.inside(node)) return;
      for_each_parent(node, ratio_,
                      [&](IntVec3 parent, double) { coarse.find_or_add(shape.block_of(parent)); });
    });
  }
  coarse_nodes.fit(coarse);
}

void CompositeNodes::hang_block(const BlockTable& fine, NodeLanes& fine_nodes,
                                const BlockTable& coarse, NodeLanes& coarse_nodes, int b,
                                bool add) const {
  const BlockShape& shape = fine.shape();
  const IntVec3 low = shape.lower(fine.block(b));
  if (region_.all_inside(low, low + shape.edge)) return;
  for_each_node(shape, low, [&](int n, IntVec3 node) {
    std::int64_t* from = fine_nodes.sums(b) + n * lanes;
    if (from[count_lane] == 0 || region_.inside(node)) return;
    if (add)
      for_each_parent(node, ratio_, [&](IntVec3 parent, double weight) {
        std::int64_t* to = lanes_at(coarse, coarse_nodes, parent);
        if (to == nullptr) return;
        for (int l = 0; l < count_lane; ++l)
          if (from[l] != 0)  // velocities that are mapped back bring no forces
            to[l] = wrapped_sum(
                to[l], static_cast<std::int64_t>(std::nearbyint(sum_in(from, l) * weight)) +
                           rounding_bits);
        to[count_lane] = wrapped_sum(to[count_lane], rounding_bits);
      });
    for (int l = 0; l < lanes; ++l) from[l] = 0;
  });
}

void CompositeNodes::from_coarse(const BlockTable& fine, NodeLanes& fine_nodes,
                                 const BlockTable& coarse, const NodeLanes& coarse_nodes) const {
  const BlockShape& shape = fine.shape();
  for (int b = 0; b < fine.count(); ++b) {
    const IntVec3 low = shape.lower(fine.block(b));
    if (region_.all_inside(low, low + shape.edge)) continue;
    for_each_node(shape, low, [&](int n, IntVec3 node) {
      if (region_.inside(node)) return;
      double value[lanes] = {};
      for_each_parent(node, ratio_, [&](IntVec3 parent, double weight) {
        const std::int64_t* from = lanes_at(coarse, coarse_nodes, parent);
        if (from == nullptr) return;
        for (int l = 0; l < lanes; ++l) value[l] += weight * as_real(from[l]);
      });
      std::int64_t* to = fine_nodes.sums(b) + n * lanes;
      for (int l = 0; l < lanes; ++l) to[l] = as_bits(value[l]);
    });
  }
}

void CompositeNodes::from_fine(const BlockTable& coarse, NodeLanes& coarse_nodes,
                               const BlockTable& fine, const NodeLanes& fine_nodes) const {
  const BlockShape& shape = coarse.shape();
  for (int b = 0; b < coarse.count(); ++b) {
    const IntVec3 low = shape.lower(coarse.block(b));
    if (!region_.meets_coarse(low, low + shape.edge)) continue;
    for_each_node(shape, low, [&](int n, IntVec3 node) {
      const IntVec3 at = node * ratio_;
      if (!region_.inside(at)) return;
      const std::int64_t* from = lanes_at(fine, fine_nodes, at);
      if (from == nullptr) return;
      std::int64_t* to = coarse_nodes.sums(b) + n * lanes;
      for (int l = 0; l < lanes; ++l) to[l] = from[l];
    });
  }
}

}  // namespace sluice::mpm
