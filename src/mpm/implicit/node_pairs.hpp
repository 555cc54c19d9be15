// Which nodes act on each other, and where the block of two nodes is in a matrix of blocks.
//
// Nodes act on each other if one particle reaches both. The table has one entry for each offset
// between two nodes, so that a pair is found without a search.
#pragma once
#include "framework/solve/block/block_rows.hpp"
#include "framework/task/thread_team.hpp"
#include "mpm/implicit/nodes_of_step.hpp"

namespace sluice::mpm {

solve::Workers workers_of(const ThreadTeam& team);  // which must stay

// Three nodes in a row along a direction of the grid.
using NodeTriple = std::array<std::int32_t, 3>;

class NodePairs {
 public:
  struct Which {
    bool with_rigid = false;  // particles of all kinds, not only of those that deform
    bool triples = false;     // triples may be added
  };
  // Pairs of nodes that one particle reaches.
  NodePairs(const NodesOfStep::Parts& parts, Which which, const solve::Workers& workers);

  std::size_t count() const { return at_.size(); }
  // Does a particle reach both. Valid before number().
  bool act(std::int32_t i, std::int32_t j) const { return slot_[entry(i, j)] >= 0; }
  // Adds the pairs of the nodes of triples. Before number().
  void add(std::span<const NodeTriple> triples);

  // A matrix with a zero block of width x width for every pair, and for every node with itself.
  solve::BlockRows number(int width);
  // After number(): the block of row i, column j in `value`, over width^2.
  std::size_t block(const solve::BlockRows& rows, std::int32_t i, std::int32_t j) const {
    return rows.begin[static_cast<std::size_t>(i)] + static_cast<std::size_t>(slot_[entry(i, j)]);
  }

 private:
  std::size_t entry(std::int32_t i, std::int32_t j) const {
    if (wraps_) return wrapped_entry(i, j);
    return static_cast<std::size_t>(i) * offsets_ +
           static_cast<std::size_t>(middle_ + line_[static_cast<std::size_t>(j)] -
                                    line_[static_cast<std::size_t>(i)]);
  }
  std::size_t wrapped_entry(std::int32_t i, std::int32_t j) const;
  void mark_pairs(const NodesOfStep::Parts& parts, bool with_rigid, std::size_t first,
                  std::size_t end);

  const ReachedNodes* reached_;
  int reach_ = 2;                   // the largest offset along a direction
  std::size_t offsets_ = 0;         // per node
  int middle_ = 0;                  // the offset of a node to itself
  bool wraps_ = false;              // some side is periodic
  IntVec3 period_;                  // in nodes; 0: not periodic
  std::vector<IntVec3> at_;         // indices from the lowest on
  std::vector<int> line_;           // indices as one number, so that offsets are differences
  std::vector<std::int16_t> slot_;  // -1: no pair; else 0, after number() the place in the row
};

}  // namespace sluice::mpm
