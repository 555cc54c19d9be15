// The cells of each box that no finer level covers, as boxes and by row.
#include "framework/refine/coverage.hpp"

#include <algorithm>
#include <numeric>

#include "framework/grid/box_list.hpp"
#include "framework/refine/box_pieces.hpp"

namespace sluice {
namespace {

// Finds what of a box and of one layer around it the boxes of a finer level and their periodic
// images cover.
class Covered {
 public:
  Covered(const Level& level, const BoxFinder& finder)
      : finder_(finder), layer_(level.ghosts(1)), period_(level.domain.size()) {
    for (int d = 0; d < 3; ++d) {
      images_[d] = level.active[d] && level.periodic[d] ? 1 : 0;
    }
  }

  // Appends parts that lie inside whole, others as far as the layer goes.
  void find(const IndexBox& cells, std::vector<IndexBox>& inside, std::vector<IndexBox>& around) {
    const IndexBox grown = cells.grown(layer_);
    for_each_cell({IntVec3{} - images_, images_ + IntVec3::all(1)}, [&](IntVec3 image) {
      const IntVec3 shift = image * period_;
      finder_.find(grown.shifted(shift), found_);
      for (const int n : found_) {
        const IndexBox box = finder_.boxes()[n].shifted(IntVec3{} - shift);
        if (image == IntVec3{} && !intersection(cells, box).empty()) inside.push_back(box);
        if (!cells.contains(box)) around.push_back(intersection(grown, box));
      }
    });
  }

 private:
  const BoxFinder& finder_;
  IntVec3 layer_, images_{}, period_;
  std::vector<int> found_;
};

}  // namespace

LevelCoverage::LevelCoverage(const Level& level, const Level* finer, int rank)
    : along_(row_direction(level.active)) {
  std::vector<IndexBox> above;
  if (finer != nullptr)
    for (const GridBox& b : finer->boxes) above.push_back(coarsen(b.cells, finer->ratio));
  any_ = !above.empty();
  const BoxFinder finder(std::move(above));
  Covered covered(level, finder);
  std::vector<IndexBox> inside, pieces;
  for (const GridBox& b : level.boxes) {
    if (b.owner != rank) continue;
    inside.clear();
    Box& box = boxes_.emplace_back();
    box.cells = b.cells;
    box.whole_row = {b.cells.lower[along_], b.cells.size()[along_]};
    if (any_) covered.find(b.cells, inside, box.around);
    if (inside.empty()) {
      box.uncovered = {b.cells};
    } else {
      box.uncovered = pieces_without(b.cells, inside, along_);
      list_rows(box, pieces);
    }
  }
}

std::size_t LevelCoverage::row_number(const Box& box, IntVec3 cell) const {
  IntVec3 place = cell - box.cells.lower, size = box.cells.size();
  place[along_] = 0;
  size[along_] = 1;
  return place.x + size.x * (place.y + size.y * place.z);
}

void LevelCoverage::list_rows(Box& box, std::vector<IndexBox>& pieces) const {
  pieces = box.uncovered;
  std::sort(pieces.begin(), pieces.end(), [&](const IndexBox& a, const IndexBox& b) {
    return a.lower[along_] > b.lower[along_];
  });
  const auto each_row = [&](const IndexBox& piece, auto&& f) {
    IndexBox starts = piece;
    starts.upper[along_] = starts.lower[along_] + 1;
    for_each_cell(starts, [&](IntVec3 c) { f(row_number(box, c)); });
  };
  box.begin.assign(row_number(box, box.cells.upper - IntVec3::all(1)) + 2, 0);
  for (const IndexBox& p : pieces) each_row(p, [&](std::size_t row) { ++box.begin[row]; });
  std::partial_sum(box.begin.begin(), box.begin.end(), box.begin.begin());
  box.segments.resize(box.begin.back());
  for (const IndexBox& p : pieces)  // descending, from the end of every row
    each_row(p, [&](std::size_t row) {
      box.segments[--box.begin[row]] = {p.lower[along_], p.size()[along_]};
    });
}

std::span<const LevelCoverage::Segment> LevelCoverage::uncovered_in_row(int box,
                                                                        IntVec3 cell) const {
  const Box& b = boxes_[box];
  if (b.begin.empty()) return {&b.whole_row, 1};
  const std::size_t row = row_number(b, cell);
  const std::size_t first = b.begin[row];
  return {b.segments.data() + first, b.begin[row + 1] - first};
}

bool LevelCoverage::is_covered(int box, IntVec3 cell) const {
  if (!boxes_[box].cells.contains(cell)) return false;
  for (const Segment& s : uncovered_in_row(box, cell))
    if (cell[along_] >= s.first && cell[along_] < s.first + s.count) return false;
  return true;
}

bool LevelCoverage::is_covered_around(int box, IntVec3 cell) const {
  const Box& b = boxes_[box];
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
