// Lists of the boxes of a level.
#pragma once
#include <algorithm>
#include <vector>

#include "framework/grid/level.hpp"

namespace sluice {

inline std::vector<IndexBox> cells_of(const std::vector<GridBox>& boxes) {
  std::vector<IndexBox> cells;
  cells.reserve(boxes.size());
  for (const GridBox& b : boxes) cells.push_back(b.cells);
  return cells;
}

// The same cells with the same owners, in the same order.
inline bool same_boxes(const std::vector<GridBox>& a, const std::vector<GridBox>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const GridBox& x, const GridBox& y) {
    return x.cells == y.cells && x.owner == y.owner;
  });
}

}  // namespace sluice
