// The cells of each box that no finer level covers, as boxes and by row.
#include "framework/refine/coverage.hpp"

#include <algorithm>

#include "framework/grid/box_list.hpp"
#include "framework/refine/box_pieces.hpp"

namespace sluice {
namespace {

// What the finder's boxes and their periodic images cover of the layer around a box.
std::vector<IndexBox> covered_around(const IndexBox& cells, const Level& level,
                                     const BoxFinder& finder) {
  IntVec3 layer{}, images{};
  for (int d = 0; d < 3; ++d) {
    const auto n = static_cast<std::size_t>(d);
    layer[d] = level.active[n] ? 1 : 0;
    images[d] = level.active[n] && level.periodic[n] ? 1 : 0;
  }
  const IndexBox grown = cells.grown(layer);
  const std::vector<IndexBox> parts = subtract(grown, cells);
  std::vector<IndexBox> covered;
  for_each_cell(IndexBox{IntVec3{} - images, images + IntVec3::all(1)}, [&](IntVec3 image) {
    const IntVec3 shift = image * level.domain.size();
    for (const int n : finder.overlapping(grown.shifted(shift))) {
      const IndexBox box = finder.boxes()[static_cast<std::size_t>(n)].shifted(IntVec3{} - shift);
      for (const IndexBox& part : parts)
        if (const IndexBox both = intersection(part, box); !both.empty()) covered.push_back(both);
    }
  });
  return covered;
}

}  // namespace

LevelCoverage::LevelCoverage(const Level& level, const Level* finer, int rank)
    : along_(row_direction(level.active)) {
  std::vector<IndexBox> above;
  if (finer != nullptr)
    for (const GridBox& b : finer->boxes) above.push_back(coarsen(b.cells, finer->ratio));
  any_ = !above.empty();
  const BoxFinder finder(std::move(above));
  for (const GridBox& b : level.boxes) {
    if (b.owner != rank) continue;
    std::vector<IndexBox> covered;
    for (const int n : finder.overlapping(b.cells))
      covered.push_back(finder.boxes()[static_cast<std::size_t>(n)]);
    Box& box = boxes_.emplace_back();
    box.cells = b.cells;
    if (covered.empty())
      box.uncovered = {b.cells};
    else
      box.uncovered = pieces_without(b.cells, covered, along_);
    if (any_) box.around = covered_around(b.cells, level, finder);
    list_rows(box);
  }
}

std::size_t LevelCoverage::row_number(const Box& box, IntVec3 cell) const {
  IntVec3 place = cell - box.cells.lower, size = box.cells.size();
  place[along_] = 0;
  size[along_] = 1;
  return static_cast<std::size_t>(place.x + size.x * (place.y + size.y * place.z));
}

void LevelCoverage::list_rows(Box& box) const {
  std::vector<IndexBox> pieces = box.uncovered;
  std::sort(pieces.begin(), pieces.end(), [&](const IndexBox& a, const IndexBox& b) {
    return a.lower[along_] < b.lower[along_];
  });
  const auto each_row = [&](const IndexBox& piece, auto&& f) {
    IndexBox starts = piece;
    starts.upper[along_] = starts.lower[along_] + 1;
    for_each_cell(starts, [&](IntVec3 c) { f(row_number(box, c)); });
  };
  box.begin.assign(row_number(box, box.cells.upper - IntVec3::all(1)) + 2, 0);
  for (const IndexBox& p : pieces) each_row(p, [&](std::size_t row) { ++box.begin[row + 1]; });
  for (std::size_t n = 1; n < box.begin.size(); ++n) box.begin[n] += box.begin[n - 1];
  box.segments.resize(static_cast<std::size_t>(box.begin.back()));
  std::vector<std::int32_t> next = box.begin;
  for (const IndexBox& p : pieces)
    each_row(p, [&](std::size_t row) {
      box.segments[static_cast<std::size_t>(next[row]++)] = {p.lower[along_], p.size()[along_]};
    });
}

std::span<const LevelCoverage::Segment> LevelCoverage::uncovered_in_row(int box,
                                                                        IntVec3 cell) const {
  const Box& b = boxes_[static_cast<std::size_t>(box)];
  const std::size_t row = row_number(b, cell);
  const auto first = static_cast<std::size_t>(b.begin[row]);
  return {b.segments.data() + first, static_cast<std::size_t>(b.begin[row + 1]) - first};
}

bool LevelCoverage::is_covered(int box, IntVec3 cell) const {
  if (!boxes_[static_cast<std::size_t>(box)].cells.contains(cell)) return false;
  for (const Segment& s : uncovered_in_row(box, cell))
    if (cell[along_] >= s.first && cell[along_] < s.first + s.count) return false;
  return true;
}

bool LevelCoverage::is_covered_around(int box, IntVec3 cell) const {
  const Box& b = boxes_[static_cast<std::size_t>(box)];
  if (b.cells.contains(cell)) return is_covered(box, cell);
  return std::any_of(b.around.begin(), b.around.end(),
                     [&](const IndexBox& part) { return part.contains(cell); });
}

std::int64_t LevelCoverage::uncovered_cells() const {
  std::int64_t cells = 0;
  for (const Box& b : boxes_)
    for (const IndexBox& p : b.uncovered) cells += p.volume();
  return cells;
}

}  // namespace sluice
