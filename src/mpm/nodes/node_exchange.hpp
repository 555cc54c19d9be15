// Sums of nodes that particles of several ranks reach: the same on all of them afterwards.
//
// Each block has a home, the rank that owns the cells there. What other ranks have summed goes to
// the home, which adds it (integers: in any order) and sends the total back. Messages go between
// neighbours alone.
#pragma once
#include <span>
#include <vector>

#include "framework/base/communicator.hpp"
#include "framework/grid/box_list.hpp"
#include "framework/grid/level.hpp"
#include "mpm/nodes/node_blocks.hpp"

namespace sluice::mpm {

// The blocks of a table that went to neighbours and came from them when it was shared, in the order
// in which they went.
struct SharedBlocks {
  std::vector<std::vector<IntVec3>> sent, arrived;  // by neighbour
};

class NodeExchange {
 public:
  // `everywhere`: particles may reach nodes of any rank, not only of boxes beside theirs.
  NodeExchange(const Level& level, Communicator& ranks, bool everywhere = false);

  // Were the boxes the same when this was made, and may particles reach as far.
  bool fits(const Level& level, bool everywhere = false) const;
  // Collective: groups of lanes of one table. Blocks that others reach may be added.
  SharedBlocks share(BlockTable& table, std::span<NodeLanes* const> groups);
  // One more group of a table that was shared as `blocks` tells, of the blocks alone that `wanted`
  // marks by number: all ranks that have a block must mark it alike. Nothing is sent where none is.
  void share_some(const BlockTable& table, NodeLanes& group, const SharedBlocks& blocks,
                  const std::vector<char>& wanted);
  // Does this rank keep the books of a block: each block has one such rank.
  bool is_home(const BlockTable& table, int block) const {
    return ranks_->size() == 1 || home(table.shape(), table.block(block)) == ranks_->rank();
  }

 private:
  int home(const BlockShape& shape, IntVec3 block) const;
  using Buffers = std::vector<std::vector<double>>;  // by neighbour
  Buffers swap(const Buffers& out);
  Buffers pass(int tag, const Buffers& out, std::span<const std::size_t> sizes_in);

  Level level_;
  Communicator* ranks_;
  bool everywhere_;
  BoxFinder finder_;
  std::vector<int> neighbours_;  // ranks
  std::vector<int> number_;      // of a rank among them; -1
};

}  // namespace sluice::mpm
