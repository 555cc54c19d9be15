// Building a table of faces, and asking it whether a block has any.
#include "framework/refine/face_table.hpp"

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <tuple>

namespace sluice {

Axes active_axes(const Level& level) {
  Axes axes;
  axes.count = 0;
  for (int d = 0; d < 3; ++d)
    if (level.active[d]) axes.direction[axes.count++] = d;
  return axes;
}

FaceTable::FaceTable(const std::vector<GridBox>& boxes, const Axes& axes, int quantities)
    : rows_(boxes.size() * axes.count), quantities_(quantities), axes_(axes) {
  boxes_.reserve(boxes.size());
  for (const GridBox& b : boxes) boxes_.push_back(b.cells);
}

std::ptrdiff_t FaceTable::add(int box, int axis, bool high, const IndexBox& cells) {
  const IndexBox& whole = boxes_[box];
  if (cells.size()[axes_.direction[axis]] != 1 || !whole.contains(cells))
    throw std::logic_error("faces to record must be one layer of cells of their box");
  Rows& r = rows(box, axis);
  r.cells = r.cells.empty() ? cells : bounding(r.cells, cells);
  const std::ptrdiff_t first_slot = faces_;
  layers_.push_back({box, axis, high, cells, first_slot});
  faces_ += cells.volume();
  return first_slot;
}

// Calls f(row) for the rows of a layer in the order of its slots.
template <class F>
void FaceTable::for_each_row(const Layer& layer, F&& f) const {
  const IndexBox& whole = boxes_[layer.box];
  const int n = cells_along(whole, 1), rows_along = cells_along(layer.cells, 1),
            planes = cells_along(layer.cells, 2);
  const std::ptrdiff_t first = rows(layer.box, layer.axis).first +
                               place(whole, 1, layer.cells.lower) +
                               n * static_cast<std::ptrdiff_t>(place(whole, 2, layer.cells.lower));
  for (std::ptrdiff_t k = 0; k < planes; ++k)
    for (std::ptrdiff_t j = 0; j < rows_along; ++j) f(first + j + n * k);
}

std::ptrdiff_t FaceTable::number_rows() {
  std::ptrdiff_t count = 0;
  for (std::size_t n = 0; n < rows_.size(); ++n) {
    if (rows_[n].cells.empty()) continue;
    const IndexBox& box = boxes_[n / axes_.count];
    rows_[n].first = count;
    count += static_cast<std::ptrdiff_t>(cells_along(box, 1)) * cells_along(box, 2);
  }
  return count;
}

void FaceTable::seal() {
  begin_.assign(number_rows() + 1, 0);
  for (const Layer& l : layers_) for_each_row(l, [&](std::size_t row) { ++begin_[row]; });
  std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
  segments_.resize(begin_.back());
  const int along = axes_.direction[0];
  for (const Layer& l : layers_) {
    Segment s{l.cells.lower[along], l.cells.size()[along], l.high, l.slot};
    for_each_row(l, [&](std::size_t row) {  // from the end of every row
      segments_[--begin_[row]] = s;
      s.slot += s.count;
    });
  }
  for (std::size_t row = 0; row + 1 < begin_.size(); ++row)
    if (begin_[row + 1] - begin_[row] > 1)
      std::sort(segments_.begin() + begin_[row], segments_.begin() + begin_[row + 1],
                [](const Segment& a, const Segment& b) {
                  return std::tuple(a.first, a.high, a.slot) < std::tuple(b.first, b.high, b.slot);
                });
  layers_ = {};
  values_.assign(quantities_ * faces_, 0.0);
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
  std::fill(values_.begin(), values_.end(), 0.0);
}

std::size_t FaceTable::bytes() const {
  return begin_.capacity() * sizeof(std::int32_t) + segments_.capacity() * sizeof(Segment) +
         values_.capacity() * sizeof(double);
}

}  // namespace sluice
