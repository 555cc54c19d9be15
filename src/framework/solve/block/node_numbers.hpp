// Numbers of some of the nodes of a grid, found by the index of a node.
//
// Nodes are marked first and numbered then, along x, y and z. The table has tiles of 8 nodes in
// each direction, so that its memory follows the marked nodes and not the box around them.
#pragma once
#include <cstdint>
#include <vector>

#include "framework/base/vec3.hpp"

namespace sluice::solve {

class NodeNumbers {
 public:
  NodeNumbers() = default;
  // Indices that may be marked: from lower to below upper. A node may be marked more than once.
  NodeNumbers(IntVec3 lower, IntVec3 upper);

  void mark(IntVec3 node);
  // Numbers the marked nodes from 0 on and returns their indices in that order. Call it once.
  std::vector<IntVec3> number();
  // -1 for a node that is not marked or lies outside; valid after number().
  std::int32_t operator()(IntVec3 node) const {
    const IntVec3 i = node - lower_;
    if (!contains(i)) return -1;
    const std::int32_t tile = tiles_[tile_of(i)];
    return tile < 0 ? -1 : numbers_[at(tile, i)];
  }

 private:
  bool contains(IntVec3 i) const {
    return i.x >= 0 && i.y >= 0 && i.z >= 0 && i.x < size_.x && i.y < size_.y && i.z < size_.z;
  }
  std::size_t tile_of(IntVec3 i) const {
    return static_cast<std::size_t>(i.x >> shift_.x) +
           static_cast<std::size_t>(count_.x) *
               (static_cast<std::size_t>(i.y >> shift_.y) +
                static_cast<std::size_t>(count_.y) * static_cast<std::size_t>(i.z >> shift_.z));
  }
  std::size_t at(std::int32_t tile, IntVec3 i) const {
    const int x = i.x & ((1 << shift_.x) - 1), y = i.y & ((1 << shift_.y) - 1),
              z = i.z & ((1 << shift_.z) - 1);
    return (static_cast<std::size_t>(tile) << (shift_.x + shift_.y + shift_.z)) +
           static_cast<std::size_t>(x + (y << shift_.x) + (z << (shift_.x + shift_.y)));
  }

  IntVec3 lower_, size_, shift_, count_;  // shift: the logarithm of a tile's size
  std::vector<std::int32_t> tiles_;       // -1: no node of the tile is marked
  std::vector<std::int32_t> numbers_;     // of the nodes of marked tiles; -1: not marked
};

}  // namespace sluice::solve
