// Set operations on boxes, and bins to find them by.
#include "framework/grid/box_list.hpp"

#include <algorithm>
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

std::vector<IndexBox> subtract(std::vector<IndexBox> boxes, const std::vector<IndexBox>& holes) {
  std::vector<IndexBox> left;
  for (const IndexBox& hole : holes) {
    const auto met = [&](const IndexBox& b) { return meet(b, hole); };
    if (std::none_of(boxes.begin(), boxes.end(), met)) continue;
    left.clear();
    for (const IndexBox& b : boxes)
      if (met(b))
        append_rest(b, hole, left);
      else
        left.push_back(b);
    std::swap(boxes, left);
  }
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
    bin_size_[d] = std::max(1, total[d] / n);
    bins_[d] = (bounds_.size()[d] + bin_size_[d] - 1) / bin_size_[d];
  }
  begin_.assign(static_cast<std::size_t>(bins_.x) * static_cast<std::size_t>(bins_.y) *
                        static_cast<std::size_t>(bins_.z) +
                    1,
                0);
  for (const IndexBox& b : boxes_) for_each_bin(b, [&](std::size_t bin) { ++begin_[bin]; });
  std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
  members_.resize(static_cast<std::size_t>(begin_.back()));
  for (int m = n; m-- > 0;)  // from the end of every bin, so that members ascend
    for_each_bin(boxes_[static_cast<std::size_t>(m)],
                 [&](std::size_t bin) { members_[static_cast<std::size_t>(--begin_[bin])] = m; });
}

// The bins that a region within the bounds overlaps.
template <class F>
void BoxFinder::for_each_bin(const IndexBox& region, F&& f) const {
  const IntVec3 one = IntVec3::all(1);
  for_each_cell({bin_of(region.lower), bin_of(region.upper - one) + one}, [&](IntVec3 bin) {
    f(static_cast<std::size_t>(bin.x + bins_.x * (bin.y + bins_.y * bin.z)));
  });
}

IntVec3 BoxFinder::bin_of(IntVec3 cell) const {
  return coarsen(cell - bounds_.lower, bin_size_);
}

std::vector<int> BoxFinder::overlapping(const IndexBox& region) const {
  const IndexBox seen = intersection(region, bounds_);
  std::vector<int> found;
  if (boxes_.empty() || seen.empty()) return found;
  for_each_bin(seen, [&](std::size_t bin) {
    for (int n = begin_[bin]; n < begin_[bin + 1]; ++n) {
      const int m = members_[static_cast<std::size_t>(n)];
      if (!intersection(boxes_[static_cast<std::size_t>(m)], region).empty()) found.push_back(m);
    }
  });
  if (found.size() < 2) return found;
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

std::vector<IndexBox> BoxFinder::uncovered(const IndexBox& region) const {
  std::vector<IndexBox> holes;
  for (const int m : overlapping(region)) holes.push_back(boxes_[static_cast<std::size_t>(m)]);
  return region.empty() ? std::vector<IndexBox>{} : subtract({region}, holes);
}

}  // namespace sluice
