// The cells of each box that a finer level covers, and the rest cut into boxes.
#include "framework/refine/coverage.hpp"

#include "framework/refine/box_pieces.hpp"

namespace sluice {

LevelCoverage::LevelCoverage(const Level& level, const Level* finer, int rank) {
  std::vector<IndexBox> above;
  if (finer != nullptr)
    for (const GridBox& b : finer->boxes) above.push_back(coarsen(b.cells, finer->ratio));
  any_ = !above.empty();
  const BoxFinder finder(std::move(above));
  const int row = row_direction(level.active);
  for (const GridBox& b : level.boxes) {
    if (b.owner != rank) continue;
    std::vector<IndexBox>& covered = covered_.emplace_back();
    for (const int n : finder.overlapping(b.cells))
      covered.push_back(intersection(finder.boxes()[static_cast<std::size_t>(n)], b.cells));
    covered = joined(std::move(covered), row);
    uncovered_.push_back(pieces_without(b.cells, covered, row));
  }
}

bool LevelCoverage::is_covered(int box, IntVec3 cell) const {
  for (const IndexBox& c : covered_[static_cast<std::size_t>(box)])
    if (c.contains(cell)) return true;
  return false;
}

std::int64_t LevelCoverage::uncovered_cells() const {
  std::int64_t cells = 0;
  for (const std::vector<IndexBox>& pieces : uncovered_)
    for (const IndexBox& p : pieces) cells += p.volume();
  return cells;
}

}  // namespace sluice
