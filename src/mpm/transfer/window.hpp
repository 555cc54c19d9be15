// The nodes that the particles of one block of cells reach: dense, in the cache of one thread.
#pragma once
#include <cstdint>
#include <vector>

#include "mpm/nodes/node_blocks.hpp"

namespace sluice::mpm {

// Particles stray less than this from the block in which they were sorted, in cells.
inline constexpr double max_stray = 0.49;

class Window {
 public:
  // `reach`: layers of nodes below and above the nodes of the block's cells.
  Window(const BlockShape& shape, int reach);

  // Moves to a block, or to the nodes between two corners (inclusive); all lanes zero.
  void begin(IntVec3 block);
  void begin(IntVec3 lowest, IntVec3 highest);
  // Moves there, where all lanes that are read will be written.
  void move_to(IntVec3 lowest, IntVec3 highest);
  // Moves there and takes lanes from the table.
  void load(IntVec3 block, const BlockTable& table, const NodeLanes& from);
  void load(IntVec3 lowest, IntVec3 highest, const BlockTable& table, const NodeLanes& from);
  // Adds all lanes of nodes that were touched; the blocks must be there. With several threads the
  // adding is atomic.
  void add_to(const BlockTable& table, NodeLanes& to, bool shared) const;

  // Is a lane of any node not zero.
  bool any_in(int lane) const;

  IntVec3 lower() const { return lower_; }
  int size(int d) const { return size_[d]; }
  // Distance in memory of nodes that follow each other along a direction, in lanes.
  std::ptrdiff_t stride(int d) const {
    return lanes * (d == 0 ? 1 : d == 1 ? size_.x : static_cast<std::ptrdiff_t>(size_.x) * size_.y);
  }
  // Lanes of a node counted from lower().
  std::int64_t* at(int i, int j, int k) {
    return lanes_.data() + lanes * (i + size_.x * (j + static_cast<std::ptrdiff_t>(size_.y) * k));
  }
  const std::int64_t* at(int i, int j, int k) const {
    return const_cast<Window*>(this)->at(i, j, k);
  }

 private:
  void take(const BlockTable& table, const NodeLanes& from);
  template <class Act>
  void for_each_part(const BlockTable& table, Act&& act) const;

  BlockShape shape_;
  int reach_;
  IntVec3 lower_{}, size_{};
  AlignedVector<std::int64_t> lanes_;
};

// Adds the blocks that a stencil reaches from places between two corners (nodes, inclusive).
void add_blocks(BlockTable& table, IntVec3 lowest, IntVec3 highest);

}  // namespace sluice::mpm
