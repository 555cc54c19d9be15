// Set operations on boxes, and bins to find them by.
#include "framework/grid/box_list.hpp"

#include <algorithm>
#include <bit>
#include <numeric>

namespace sluice {
namespace {

int floor_divide(int a, int b) {
  return a >= 0 ? a / b : -((b - 1 - a) / b);
}

}  // namespace

IntVec3 coarsen(IntVec3 c, IntVec3 ratio) {
  return {floor_divide(c.x, ratio.x), floor_divide(c.y, ratio.y), floor_divide(c.z, ratio.z)};
}

IndexBox coarsen(const IndexBox& fine, IntVec3 ratio) {
  const IntVec3 one = IntVec3::all(1);
  return {coarsen(fine.lower, ratio), coarsen(fine.upper - one, ratio) + one};
}

IndexBox refine(const IndexBox& coarse, IntVec3 ratio) {
  return {coarse.lower * ratio, coarse.upper * ratio};
}

namespace {

// Appends what is left of `box` without `hole`, which meet.
void append_rest(const IndexBox& box, const IndexBox& hole, std::vector<IndexBox>& pieces) {
  const IndexBox common = intersection(box, hole);
  IndexBox rest = box;
  // Whole slabs along z, then y, then x: pieces keep long rows.
  for (int d = 2; d >= 0; --d) {
    IndexBox low = rest, high = rest;
    low.upper[d] = common.lower[d];
    high.lower[d] = common.upper[d];
    if (!low.empty()) pieces.push_back(low);
    if (!high.empty()) pieces.push_back(high);
    rest.lower[d] = common.lower[d];
    rest.upper[d] = common.upper[d];
  }
}

bool meet(const IndexBox& a, const IndexBox& b) {
  return !intersection(a, b).empty();
}

}  // namespace

std::vector<IndexBox> subtract(const IndexBox& box, const IndexBox& hole) {
  std::vector<IndexBox> pieces;
  if (meet(box, hole))
    append_rest(box, hole, pieces);
  else if (!box.empty())
    pieces.push_back(box);
  return pieces;
}

namespace {

// Takes a hole out of all boxes; `left` is room to work.
void take_out(const IndexBox& hole, std::vector<IndexBox>& boxes, std::vector<IndexBox>& left) {
  const auto met = [&](const IndexBox& b) { return meet(b, hole); };
  if (std::none_of(boxes.begin(), boxes.end(), met)) return;
  left.clear();
  for (const IndexBox& b : boxes)
    if (met(b))
      append_rest(b, hole, left);
    else
      left.push_back(b);
  std::swap(boxes, left);
}

}  // namespace

std::vector<IndexBox> subtract(std::vector<IndexBox> boxes, const std::vector<IndexBox>& holes) {
  std::vector<IndexBox> left;
  for (const IndexBox& hole : holes) take_out(hole, boxes, left);
  return boxes;
}

BoxFinder::BoxFinder(std::vector<IndexBox> boxes) : boxes_(std::move(boxes)) {
  if (boxes_.empty()) return;
  bounds_ = boxes_.front();
  IntVec3 total{};
  for (const IndexBox& b : boxes_) {
    bounds_ = bounding(bounds_, b);
    total = total + b.size();
  }
  const auto n = static_cast<int>(boxes_.size());
  for (int d = 0; d < 3; ++d) {
    shift_[d] = std::bit_width(static_cast<unsigned>(std::max(1, total[d] / n))) - 1;
    bins_[d] = ((bounds_.size()[d] - 1) >> shift_[d]) + 1;
  }
  begin_.assign(number({0, 0, bins_.z}) + 1, 0);
  for (const IndexBox& b : boxes_)
    for_each_cell(bins_of(b), [&](IntVec3 bin) { ++begin_[number(bin)]; });
  std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
  members_.resize(begin_.back());
  for (int m = n; m-- > 0;)  // from the end of every bin, so that members ascend
    for_each_cell(bins_of(boxes_[m]), [&](IntVec3 bin) { members_[--begin_[number(bin)]] = m; });
}

// The bins that a region within the bounds overlaps.
IndexBox BoxFinder::bins_of(const IndexBox& region) const {
  const IntVec3 one = IntVec3::all(1);
  return {bin_of(region.lower), bin_of(region.upper - one) + one};
}

IntVec3 BoxFinder::bin_of(IntVec3 cell) const {
  const IntVec3 c = cell - bounds_.lower;
  return {c.x >> shift_.x, c.y >> shift_.y, c.z >> shift_.z};
}

std::size_t BoxFinder::number(IntVec3 bin) const {
  const std::size_t x = bin.x, y = bin.y, z = bin.z;
  return x + bins_.x * (y + static_cast<std::size_t>(bins_.y) * z);
}

std::vector<int> BoxFinder::overlapping(const IndexBox& region) const {
  std::vector<int> found;
  find(region, found);
  return found;
}

void BoxFinder::find(const IndexBox& region, std::vector<int>& found) const {
  found.clear();
  const IndexBox seen = intersection(region, bounds_);
  if (boxes_.empty() || seen.empty()) return;
  const IndexBox bins = bins_of(seen);
  for_each_cell(bins, [&](IntVec3 bin) {
    const std::size_t at = number(bin);
    for (int n = begin_[at]; n < begin_[at + 1]; ++n) {
      const int m = members_[n];
      const IndexBox common = intersection(boxes_[m], seen);
      if (!common.empty() && bin_of(common.lower) == bin) found.push_back(m);  // once
    }
  });
  if (!std::is_sorted(found.begin(), found.end())) std::sort(found.begin(), found.end());
}

std::vector<IndexBox> BoxFinder::uncovered(const IndexBox& region) const {
  std::vector<IndexBox> pieces, left;
  if (region.empty()) return pieces;
  pieces.push_back(region);
  for (const int m : overlapping(region)) take_out(boxes_[m], pieces, left);
  return pieces;
}

}  // namespace sluice
