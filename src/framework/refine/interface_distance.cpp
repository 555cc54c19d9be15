// Looking from every box, along every axis, for the cells that the level lacks.
#include "framework/refine/interface_distance.hpp"

#include <algorithm>

#include "framework/refine/face_table.hpp"

namespace sluice {
namespace {

// The boxes of a level and their images across periodic sides, as far as `reach` around the domain.
BoxFinder with_images(const Level& level, IntVec3 reach) {
  std::vector<IndexBox> boxes;
  IndexBox seen = level.domain;
  IntVec3 images;
  for (int d = 0; d < 3; ++d) {
    images[d] = level.periodic[d] ? 1 : 0;
    seen.lower[d] -= reach[d];
    seen.upper[d] += reach[d];
  }
  const IntVec3 size = level.domain.size();
  for (const GridBox& b : level.boxes)
    for_each_cell({IntVec3{} - images, images + IntVec3{1, 1, 1}}, [&](IntVec3 n) {
      const IntVec3 shift{n.x * size.x, n.y * size.y, n.z * size.z};
      const IndexBox image{b.cells.lower + shift, b.cells.upper + shift};
      if (!intersection(image, seen).empty()) boxes.push_back(image);
    });
  return BoxFinder(std::move(boxes));
}

// The domain, without end where it is periodic.
IndexBox inside_walls(const Level& level, IndexBox region) {
  for (int d = 0; d < 3; ++d) {
    if (level.periodic[d]) continue;
    region.lower[d] = std::max(region.lower[d], level.domain.lower[d]);
    region.upper[d] = std::min(region.upper[d], level.domain.upper[d]);
  }
  return region;
}

}  // namespace

InterfaceDistance::InterfaceDistance(const Level& level, int rank, IntVec3 depth, int ghosts)
    : axes_(active_axes(level)), depth_(depth) {
  if (depth == IntVec3{} || level.boxes.empty()) return;
  const IntVec3 around = level.ghosts(ghosts);
  const BoxFinder all = with_images(level, depth + around);
  for (const GridBox& b : level.boxes)
    if (b.owner == rank) add_box(level, all, b.cells, depth, ghosts);
}

void InterfaceDistance::add_box(const Level& level, const BoxFinder& all, IndexBox box,
                                IntVec3 depth, int ghosts) {
  const IntVec3 around = level.ghosts(ghosts);
  const IndexBox cells{box.lower - around, box.upper + around};
  boxes_.push_back(cells);
  for (int axis = 0; axis < axes_.count; ++axis)
    for (const bool high : {false, true}) {
      rows_.emplace_back();
      const int d = axes_.direction[axis];
      if (depth[d] == 0) continue;
      IndexBox region = cells;
      (high ? region.upper : region.lower)[d] += high ? depth[d] : -depth[d];
      const std::vector<IndexBox> lacking = all.uncovered(inside_walls(level, region));
      if (!lacking.empty()) add_side(lacking, cells, axis, high, depth[d]);
    }
}

void InterfaceDistance::add_side(const std::vector<IndexBox>& lacking, const IndexBox& cells,
                                 int axis, bool high, int depth) {
  const int d = axes_.direction[axis], along = axes_.direction[0];
  const std::size_t width = cells.size()[along];
  Rows& r = rows_.back();
  r.begin.assign(row_count(cells), -1);
  for (const IndexBox& l : lacking) {
    IndexBox near = l;  // all from which it can be seen
    (high ? near.lower : near.upper)[d] += high ? -depth : depth;
    near = intersection(near, cells);
    if (near.empty()) continue;
    IndexBox starts = near;
    starts.upper[along] = starts.lower[along] + 1;
    for_each_cell(starts, [&](IntVec3 c) {
      std::int32_t& begin = r.begin[row_of(cells, c)];
      if (begin < 0) {
        begin = static_cast<std::int32_t>(bytes_.size());
        bytes_.resize(bytes_.size() + width, static_cast<std::uint8_t>(depth + 1));
      }
      for (; c[along] < near.upper[along]; ++c[along]) {
        const int far = std::max(0, high ? l.lower[d] - c[d] : c[d] - l.upper[d] + 1);
        std::uint8_t& kept = bytes_[begin + c[along] - cells.lower[along]];
        kept = std::min(kept, static_cast<std::uint8_t>(far));
      }
    });
  }
}

std::size_t InterfaceDistance::row_count(const IndexBox& cells) const {
  std::size_t rows = 1;
  for (int a = 1; a < axes_.count; ++a) rows *= cells.size()[axes_.direction[a]];
  return rows;
}

}  // namespace sluice
