// Which cells a level has, by number of its box: asked about any cell, through periodic sides too.
// Every rank knows all boxes of a level, so that the answers are the same on all.
#pragma once
#include <vector>

#include "framework/grid/level.hpp"

namespace sluice {

class CellMap {
 public:
  explicit CellMap(const Level& level);

  // The cell that this one stands for: the same, or its image through periodic sides.
  IntVec3 image(IntVec3 cell) const;
  // The number of its box in Level::boxes; -1: the level has no such cell.
  int box_of(IntVec3 cell) const {
    const IntVec3 c = image(cell);
    return window_.contains(c) ? boxes_[place(c)] : -1;
  }
  bool has(IntVec3 cell) const { return box_of(cell) >= 0; }
  bool in_domain(IntVec3 cell) const { return domain_.contains(image(cell)); }
  const IndexBox& window() const { return window_; }  // around all cells

 private:
  std::size_t place(IntVec3 c) const {
    const IntVec3 n = window_.size(), at = c - window_.lower;
    return at.x + n.x * (at.y + static_cast<std::size_t>(n.y) * at.z);
  }

  IndexBox domain_, window_;
  std::array<bool, 3> periodic_;
  std::vector<int> boxes_;
};

}  // namespace sluice
