// Cutting holes out of regions, and joining what is left.
#include "framework/refine/box_pieces.hpp"

#include <algorithm>
#include <tuple>

namespace sluice {
namespace {

// Cuts along slabs between the ends of holes, first along the directions that are not `row`: what
// is left along the row comes as whole rows. `depth` counts directions.
class Cutter {
 public:
  Cutter(int row, std::vector<IndexBox>& pieces)
      : order_{row == 2 ? 1 : 2, row == 0 ? 1 : 0, row}, pieces_(pieces) {}

  // All holes overlap the region.
  void cut(const IndexBox& region, std::vector<IndexBox>& holes, int depth) {
    if (holes.empty()) {
      pieces_.push_back(region);
      return;
    }
    for (const IndexBox& h : holes)
      if (h.contains(region)) return;
    const int d = order_[depth];
    std::sort(holes.begin(), holes.end(),
              [&](const IndexBox& a, const IndexBox& b) { return a.lower[d] < b.lower[d]; });
    if (depth == 2)
      gaps(region, holes, d);
    else
      slabs(region, holes, depth);
  }

 private:
  void gaps(const IndexBox& region, const std::vector<IndexBox>& holes, int d) {
    IndexBox gap = region;
    for (const IndexBox& h : holes) {
      gap.upper[d] = h.lower[d];
      if (!gap.empty()) pieces_.push_back(gap);
      gap.lower[d] = std::max(gap.lower[d], h.upper[d]);
    }
    gap.upper[d] = region.upper[d];
    if (!gap.empty()) pieces_.push_back(gap);
  }

  void slabs(const IndexBox& region, std::vector<IndexBox>& holes, int depth) {
    const int d = order_[depth];
    std::vector<int> ends;
    ends.reserve(2 * holes.size() + 2);
    for (const IndexBox& h : holes)
      for (const int end : {h.lower[d], h.upper[d]})
        if (end > region.lower[d] && end < region.upper[d]) ends.push_back(end);
    if (ends.empty()) return cut(region, holes, depth + 1);
    ends.push_back(region.lower[d]);
    ends.push_back(region.upper[d]);
    std::sort(ends.begin(), ends.end());
    ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
    std::vector<IndexBox> active, inside;
    active.reserve(holes.size());
    inside.reserve(holes.size());
    std::size_t next = 0;
    for (std::size_t n = 0; n + 1 < ends.size(); ++n) {
      std::erase_if(active, [&](const IndexBox& h) { return h.upper[d] <= ends[n]; });
      for (; next < holes.size() && holes[next].lower[d] <= ends[n]; ++next)
        if (holes[next].upper[d] > ends[n]) active.push_back(holes[next]);
      IndexBox slab = region;
      slab.lower[d] = ends[n];
      slab.upper[d] = ends[n + 1];
      inside = active;
      cut(slab, inside, depth + 1);
    }
  }

  std::array<int, 3> order_;
  std::vector<IndexBox>& pieces_;
};

// Joins neighbours along one direction.
void join_along(std::vector<IndexBox>& boxes, int d) {
  const int e = (d + 1) % 3, f = (d + 2) % 3;
  const auto key = [&](const IndexBox& b) {
    return std::tuple(b.lower[f], b.upper[f], b.lower[e], b.upper[e], b.lower[d]);
  };
  std::sort(boxes.begin(), boxes.end(),
            [&](const IndexBox& a, const IndexBox& b) { return key(a) < key(b); });
  std::size_t last = 0;  // of those that are joined
  for (std::size_t n = 1; n < boxes.size(); ++n) {
    IndexBox& before = boxes[last];
    const IndexBox& b = boxes[n];
    const bool continues = before.upper[d] == b.lower[d] && before.lower[e] == b.lower[e] &&
                           before.upper[e] == b.upper[e] && before.lower[f] == b.lower[f] &&
                           before.upper[f] == b.upper[f];
    if (continues)
      before.upper[d] = b.upper[d];
    else
      boxes[++last] = b;
  }
  boxes.resize(last + 1);
}

}  // namespace

int row_direction(const std::array<bool, 3>& active) {
  return active[0] ? 0 : active[1] ? 1 : 2;
}

std::vector<IndexBox> pieces_without(const IndexBox& region, std::vector<IndexBox> holes, int row) {
  std::vector<IndexBox> pieces;
  if (region.empty()) return pieces;
  std::erase_if(holes, [&](const IndexBox& h) { return intersection(h, region).empty(); });
  pieces.reserve(2 * holes.size() + 2);
  Cutter(row, pieces).cut(region, holes, 0);
  return joined(std::move(pieces), row);
}

std::vector<IndexBox> joined(std::vector<IndexBox> boxes, int row) {
  for (int n = 0; n < 3 && boxes.size() > 1; ++n) join_along(boxes, (row + n) % 3);
  return boxes;
}

std::vector<IntVec3> image_shifts(const Level& level, const IndexBox& region, int reach) {
  const IndexBox domain = level.domain.grown(level.ghosts(reach));
  const IntVec3 period = level.domain.size();
  // Whole numbers k with region + k period overlapping the domain; 0 where nothing wraps.
  IntVec3 first = coarsen(region.upper - IntVec3::all(1) - domain.lower, period);
  IntVec3 last = coarsen(domain.upper - IntVec3::all(1) - region.lower, period);
  for (int d = 0; d < 3; ++d) {
    const bool wraps = level.periodic[d] && level.active[d];
    first[d] = wraps ? -first[d] : 0;
    if (!wraps) last[d] = 0;
  }
  std::vector<IntVec3> shifts;
  for_each_cell({first, last + IntVec3::all(1)}, [&](IntVec3 k) { shifts.push_back(k * period); });
  return shifts;
}

std::vector<IndexBox> pieces_without_level(const IndexBox& region, const Level& level,
                                           const BoxFinder& finder) {
  std::vector<IndexBox> holes;
  std::vector<int> found;
  for (const IntVec3 shift : image_shifts(level, region, 0)) {
    finder.find(region.shifted(shift), found);
    for (const int box : found) holes.push_back(finder.boxes()[box].shifted(IntVec3{} - shift));
  }
  return pieces_without(region, std::move(holes), row_direction(level.active));
}

}  // namespace sluice
