// What a finer level covers, as nodes of both levels see it.
#pragma once
#include "framework/grid/box_list.hpp"
#include "framework/grid/level.hpp"

namespace sluice::mpm {

class FineRegion {
 public:
  explicit FineRegion(const Level& fine);

  // Fine nodes: all of [low, high) strictly inside: every cell around them is a fine one (cells
  // beyond the domain count as those at its side).
  bool all_inside(IntVec3 low, IntVec3 high) const;
  bool inside(IntVec3 node) const { return all_inside(node, node + IntVec3{1, 1, 1}); }
  // Are any fine cells around these nodes of the next coarser level.
  bool meets_coarse(IntVec3 low, IntVec3 high) const;
  IntVec3 ratio() const { return level_.ratio; }

 private:
  IndexBox cells_around(IntVec3 low, IntVec3 high) const;

  Level level_;
  BoxFinder finder_;
};

}  // namespace sluice::mpm
