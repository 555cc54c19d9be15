// The nodes of a level: where they are, what the sides of the domain ask of them, which ranks share
// them, which threads work on them.
#pragma once
#include <memory>

#include "framework/grid/block_shape.hpp"
#include "framework/grid/level.hpp"
#include "framework/task/thread_team.hpp"
#include "mpm/boundary/node_boundary.hpp"
#include "mpm/nodes/node_exchange.hpp"

namespace sluice::mpm {

struct LevelNodes {
  Level level;
  BlockShape shape;
  std::unique_ptr<NodeBoundary> boundary;
  std::unique_ptr<NodeExchange> exchange;
  const ThreadTeam* team = nullptr;

  IntVec3 lower(const BlockTable& table, int block) const {
    return shape.lower(table.block(block));
  }
  Vec3 place(IntVec3 node) const { return level.anchor + to_real(node) * level.spacing; }
  // Does this rank keep the books of a block.
  bool booked(const BlockTable& table, int block) const { return exchange->is_home(table, block); }
};

}  // namespace sluice::mpm
