// Fields on nodes, in blocks that exist only around particles: empty space costs nothing.
//
// A block holds 64 nodes (4^3, 8^2 or 64 along the active directions); a node of one group of
// fields is a cache line of eight lanes. While particles add to it a lane holds an integer (see
// node_sums.hpp), afterwards the bits of a real
// number (as_real).
#pragma once
#include <cstdint>
#include <vector>

#include "framework/base/aligned_vector.hpp"
#include "framework/base/vec3.hpp"
#include "framework/grid/block_shape.hpp"

namespace sluice::mpm {

inline constexpr int lanes = 8;
inline constexpr int block_nodes = 64;
inline constexpr int block_lanes = lanes * block_nodes;

// Node n of a block whose lowest node is `low`, x fastest.
inline IntVec3 node_of(const BlockShape& shape, IntVec3 low, int n) {
  const IntVec3 edge = shape.edge, shift = shape.shift;
  return low + IntVec3{n & (edge.x - 1), (n >> shift.x) & (edge.y - 1), n >> (shift.x + shift.y)};
}

// act(number in the block, node) for all nodes of a block whose lowest node is `low`.
template <class Act>
void for_each_node(const BlockShape& shape, IntVec3 low, Act&& act) {
  for (int n = 0; n < block_nodes; ++n) act(n, node_of(shape, low, n));
}

// Blocks are numbered in the order in which they were added.
class BlockTable {
 public:
  explicit BlockTable(const BlockShape& shape) : shape_(shape) { clear(); }

  const BlockShape& shape() const { return shape_; }
  int count() const { return static_cast<int>(blocks_.size()); }
  IntVec3 block(int n) const { return blocks_[n]; }
  int find(IntVec3 block) const;  // -1: there is none
  int find_or_add(IntVec3 block);
  void clear();

 private:
  void grow();
  std::size_t home(IntVec3 block) const;

  BlockShape shape_;
  std::vector<IntVec3> blocks_;
  std::vector<std::int32_t> table_;  // open addressing; -1: free
};

// Lanes of the blocks of a table: one group.
class NodeLanes {
 public:
  // As many blocks as the table has; new ones are zero.
  void fit(const BlockTable& table) {
    values_.resize(static_cast<std::size_t>(table.count()) * block_lanes);
  }
  void clear() { values_.clear(); }
  int blocks() const { return static_cast<int>(values_.size() / block_lanes); }
  std::int64_t* sums(int block) {
    return values_.data() + static_cast<std::size_t>(block) * block_lanes;
  }
  const std::int64_t* sums(int block) const {
    return values_.data() + static_cast<std::size_t>(block) * block_lanes;
  }
  std::size_t bytes() const { return values_.capacity() * sizeof(std::int64_t); }

 private:
  AlignedVector<std::int64_t> values_;
};

}  // namespace sluice::mpm
