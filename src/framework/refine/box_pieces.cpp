// Cutting holes out of regions, and joining what is left.
#include "framework/refine/box_pieces.hpp"

#include <algorithm>
#include <tuple>

namespace sluice {
namespace {

// More holes than this are dealt out to halves of the region: every hole is cut from every piece.
constexpr std::size_t most_holes = 12;

int widest(const IndexBox& region, int row) {
  int best = row;
  for (int d = 2; d >= 0; --d) {
    if (d == row || region.size()[d] < 2) continue;
    if (best == row || region.size()[d] > region.size()[best]) best = d;
  }
  return best;
}

void cut(const IndexBox& region, const std::vector<IndexBox>& holes, int row,
         std::vector<IndexBox>& pieces) {
  std::vector<IndexBox> inside;
  for (const IndexBox& h : holes) {
    if (h.contains(region)) return;
    if (!intersection(h, region).empty()) inside.push_back(h);
  }
  const int d = widest(region, row);  // rows are kept whole as long as possible
  if (inside.size() <= most_holes || region.size()[d] < 2) {
    for (const IndexBox& p : subtract({region}, inside)) pieces.push_back(p);
    return;
  }
  IndexBox low = region, high = region;
  low.upper[d] = high.lower[d] = region.lower[d] + region.size()[d] / 2;
  cut(low, inside, row, pieces);
  cut(high, inside, row, pieces);
}

// Joins neighbours along one direction.
void join_along(std::vector<IndexBox>& boxes, int d) {
  const int e = (d + 1) % 3, f = (d + 2) % 3;
  const auto key = [&](const IndexBox& b) {
    return std::tuple(b.lower[f], b.upper[f], b.lower[e], b.upper[e], b.lower[d]);
  };
  std::sort(boxes.begin(), boxes.end(),
            [&](const IndexBox& a, const IndexBox& b) { return key(a) < key(b); });
  std::vector<IndexBox> out;
  for (const IndexBox& b : boxes) {
    const bool continues = !out.empty() && out.back().upper[d] == b.lower[d] &&
                           out.back().lower[e] == b.lower[e] && out.back().upper[e] == b.upper[e] &&
                           out.back().lower[f] == b.lower[f] && out.back().upper[f] == b.upper[f];
    if (continues)
      out.back().upper[d] = b.upper[d];
    else
      out.push_back(b);
  }
  boxes = std::move(out);
}

}  // namespace

int row_direction(const std::array<bool, 3>& active) {
  return active[0] ? 0 : active[1] ? 1 : 2;
}

std::vector<IndexBox> pieces_without(const IndexBox& region, const std::vector<IndexBox>& holes,
                                     int row) {
  std::vector<IndexBox> pieces;
  if (!region.empty()) cut(region, holes, row, pieces);
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
    const auto n = static_cast<std::size_t>(d);
    const bool wraps = level.periodic[n] && level.active[n];
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
  for (const IntVec3 shift : image_shifts(level, region, 0))
    for (const int box : finder.overlapping(region.shifted(shift)))
      holes.push_back(finder.boxes()[static_cast<std::size_t>(box)].shifted(IntVec3{} - shift));
  return pieces_without(region, holes, row_direction(level.active));
}

}  // namespace sluice
