// Boxes of the finer level, coarsened, and the cells that they hold.
#include "framework/archive/drawing/covered_cells.hpp"

namespace sluice {

CoveredCells::CoveredCells(const Grid& grid, std::size_t level) {
  if (level + 1 >= grid.levels.size()) return;
  const Level& fine = grid.levels[level + 1];
  std::vector<IndexBox> coarse;
  for (const GridBox& b : fine.boxes) coarse.push_back(coarsen(b.cells, fine.ratio));
  finer_.emplace(std::move(coarse));
}

bool CoveredCells::any(const IndexBox& cells) const {
  return finer_ && !finer_->overlapping(cells).empty();
}

std::vector<std::uint8_t> CoveredCells::ghost_types(const IndexBox& cells) const {
  constexpr std::uint8_t duplicate = 1, refined = 8;
  std::vector<std::uint8_t> types(cells.volume(), 0);
  if (!finer_) return types;
  const IntVec3 n = cells.size();
  for (const int box : finer_->overlapping(cells))
    for_each_cell(intersection(finer_->boxes()[box], cells), [&](IntVec3 c) {
      const IntVec3 r = c - cells.lower;
      types[r.x + n.x * (r.y + static_cast<std::size_t>(n.y) * r.z)] = duplicate | refined;
    });
  return types;
}

}  // namespace sluice
