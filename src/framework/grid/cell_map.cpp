#include "framework/grid/cell_map.hpp"

namespace sluice {

CellMap::CellMap(const Level& level) : domain_(level.domain), periodic_(level.periodic) {
  if (level.boxes.empty()) return;
  window_ = level.boxes.front().cells;
  for (const GridBox& b : level.boxes) window_ = bounding(window_, b.cells);
  boxes_.assign(window_.volume(), -1);
  for (std::size_t n = 0; n < level.boxes.size(); ++n)
    for_each_cell(level.boxes[n].cells, [&](IntVec3 c) { boxes_[place(c)] = static_cast<int>(n); });
}

IntVec3 CellMap::image(IntVec3 cell) const {
  for (int d = 0; d < 3; ++d) {
    if (!periodic_[d]) continue;
    const int n = domain_.size()[d];
    cell[d] = domain_.lower[d] + ((cell[d] - domain_.lower[d]) % n + n) % n;
  }
  return cell;
}

}  // namespace sluice
