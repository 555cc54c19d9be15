// Building a table of faces, and asking it whether a block has any.
#include "framework/refine/face_table.hpp"

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace sluice {

Axes active_axes(const Level& level) {
  Axes axes;
  axes.count = 0;
  for (int d = 0; d < 3; ++d)
    if (level.active[static_cast<std::size_t>(d)]) axes.direction[axes.count++] = d;
  return axes;
}

FaceTable::FaceTable(const std::vector<GridBox>& boxes, const Axes& axes, int quantities)
    : rows_(boxes.size() * static_cast<std::size_t>(axes.count)),
      values_(static_cast<std::size_t>(quantities)),
      axes_(axes) {
  for (const GridBox& b : boxes) boxes_.push_back(b.cells);
}

std::ptrdiff_t FaceTable::add(int box, int axis, bool high, const IndexBox& cells) {
  const IndexBox& whole = boxes_[static_cast<std::size_t>(box)];
  if (cells.size()[axes_.direction[axis]] != 1 || !whole.contains(cells))
    throw std::logic_error("faces to record must be one layer of cells of their box");
  Rows& r = rows_[static_cast<std::size_t>(box * axes_.count + axis)];
  r.cells = r.segments.empty() ? cells : bounding(r.cells, cells);
  const std::ptrdiff_t first_slot = faces_;
  const int along = axes_.direction[0];
  const int n = cells_along(whole, 1);
  IndexBox starts = cells;
  starts.upper[along] = starts.lower[along] + 1;
  for_each_cell(starts, [&](IntVec3 c) {
    const int count = cells.size()[along];
    r.segments.push_back({c[along], count, high, faces_});
    r.row_of.push_back(place(whole, 1, c) + n * place(whole, 2, c));
    faces_ += count;
  });
  return first_slot;
}

// Segments in the order of their rows.
void FaceTable::sort_rows(Rows& r, std::size_t row_count) {
  r.begin.assign(row_count + 1, 0);
  for (const std::int32_t row : r.row_of) ++r.begin[static_cast<std::size_t>(row) + 1];
  std::partial_sum(r.begin.begin(), r.begin.end(), r.begin.begin());
  std::vector<std::int32_t> next(r.begin.begin(), r.begin.end() - 1);
  std::vector<Segment> sorted(r.segments.size());
  for (std::size_t s = 0; s < r.segments.size(); ++s)
    sorted[static_cast<std::size_t>(next[static_cast<std::size_t>(r.row_of[s])]++)] = r.segments[s];
  for (std::size_t row = 0; row < row_count; ++row)
    std::sort(sorted.begin() + r.begin[row], sorted.begin() + r.begin[row + 1],
              [](const Segment& a, const Segment& b) {
                return std::pair(a.first, a.high) < std::pair(b.first, b.high);
              });
  r.segments = std::move(sorted);
  r.row_of = {};
}

void FaceTable::seal() {
  for (std::size_t n = 0; n < rows_.size(); ++n) {
    if (rows_[n].segments.empty()) continue;
    const IndexBox& box = boxes_[n / static_cast<std::size_t>(axes_.count)];
    sort_rows(rows_[n], static_cast<std::size_t>(cells_along(box, 1)) *
                            static_cast<std::size_t>(cells_along(box, 2)));
  }
  for (std::vector<double>& v : values_) v.assign(static_cast<std::size_t>(faces_), 0.0);
}

IndexBox FaceTable::cells_with_faces(int box, int axis, const IndexBox& block) const {
  const IndexBox& all = rows(box, axis).cells;
  const IndexBox part = intersection(block, all);
  if (part == all || part.empty()) return part;
  IndexBox found;
  const int along = axes_.direction[0];
  IndexBox starts = part;
  starts.upper[along] = starts.lower[along] + 1;
  for_each_cell(starts, [&](IntVec3 row) {
    for (const Segment& s : segments(box, axis, row)) {
      IndexBox cells{row, row + IntVec3::all(1)};
      cells.lower[along] = std::max(s.first, part.lower[along]);
      cells.upper[along] = std::min(s.first + s.count, part.upper[along]);
      if (!cells.empty()) found = found.empty() ? cells : bounding(found, cells);
    }
  });
  return found;
}

bool FaceTable::touches(int box, const IndexBox& block) const {
  for (int axis = 0; axis < axes_.count; ++axis)
    if (!cells_with_faces(box, axis, block).empty()) return true;
  return false;
}

void FaceTable::clear() {
  for (std::vector<double>& v : values_) std::fill(v.begin(), v.end(), 0.0);
}

std::size_t FaceTable::bytes() const {
  std::size_t n = 0;
  for (const Rows& r : rows_)
    n += r.begin.capacity() * sizeof(std::int32_t) + r.segments.capacity() * sizeof(Segment);
  for (const std::vector<double>& v : values_) n += v.capacity() * sizeof(double);
  return n;
}

}  // namespace sluice
