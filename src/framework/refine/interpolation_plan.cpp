// Finding the coarse cells that fine cells are interpolated from.
#include "framework/refine/interpolation_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <tuple>

#include "framework/grid/box_list.hpp"
#include "framework/refine/box_pieces.hpp"

namespace sluice {
namespace {

using Holder = InterpolationPlan::Holder;

class CoarseLevel {
 public:
  CoarseLevel(const Level& level, int ghosts, int rank)
      : level_(level),
        ghosts_(ghosts),
        numbers_(local_numbers(level, rank)),
        finder_(grown_boxes(level, ghosts)) {}

  // Holders of `region`, by box and shift, until asked again.
  const std::vector<Holder>& holders(const IndexBox& region) {
    holders_.clear();
    const std::vector<IntVec3> shifts = image_shifts(level_, region, ghosts_);
    for (const IntVec3 shift : shifts) {
      finder_.find(region.shifted(shift), found_);
      for (const int n : found_) {
        const GridBox& box = level_.boxes[n];
        const IntVec3 back = IntVec3{} - shift;
        holders_.push_back({n, numbers_[n], box.owner, shift, box.cells.shifted(back),
                            box.cells.grown(level_.ghosts(ghosts_)).shifted(back),
                            trusted(box.cells).shifted(back)});
      }
    }
    const auto key = [](const Holder& h) {
      return std::tuple(h.box, h.shift.z, h.shift.y, h.shift.x);
    };
    if (shifts.size() > 1)
      std::sort(holders_.begin(), holders_.end(),
                [&](const Holder& a, const Holder& b) { return key(a) < key(b); });
    return holders_;
  }

 private:
  // The ghosts that every box would fill alike. Open sides and slip walls take differences along
  // themselves, which the outermost ghosts of a box lack: beside a side they are left out, unless
  // they lie beyond another one.
  IndexBox trusted(const IndexBox& cells) const {
    const IndexBox filled = cells.grown(level_.ghosts(ghosts_)), &domain = level_.domain;
    const auto below = [&](int d) {
      return !level_.periodic[d] && filled.lower[d] < domain.lower[d];
    };
    const auto above = [&](int d) {
      return !level_.periodic[d] && filled.upper[d] > domain.upper[d];
    };
    IndexBox trusted = filled;
    for (int d = 0; d < 3; ++d)
      for (int e = 0; e < 3; ++e) {
        if (e == d || !(below(d) || above(d))) continue;
        if (!below(e)) trusted.lower[e] = std::min(cells.lower[e], filled.lower[e] + 1);
        if (!above(e)) trusted.upper[e] = std::max(cells.upper[e], filled.upper[e] - 1);
      }
    return trusted;
  }

  static std::vector<IndexBox> grown_boxes(const Level& level, int ghosts) {
    std::vector<IndexBox> boxes = cells_of(level.boxes);
    for (IndexBox& b : boxes) b = b.grown(level.ghosts(ghosts));
    return boxes;
  }
  const Level& level_;
  int ghosts_;
  std::vector<int> numbers_;
  BoxFinder finder_;
  std::vector<int> found_;
  std::vector<Holder> holders_;
};

struct Part {
  const Holder* holder = nullptr;
  IndexBox cells;
};

// Takes from `missing` what one holder has.
void take(const Holder& holder, const IndexBox& has, std::vector<IndexBox>& missing,
          std::vector<Part>& parts) {
  const std::size_t before = parts.size();
  for (const IndexBox& m : missing)
    if (const IndexBox common = intersection(m, has); !common.empty())
      parts.push_back({&holder, common});
  if (parts.size() > before) missing = subtract(std::move(missing), {has});
}

// Cuts `region` into parts: from arrays of rank `owner` where they hold it (trusted ghost cells are
// as good as the cells they stand for), else from the box of another rank whose cells they are,
// else from ghost cells that no box of the level holds.
std::vector<Part> parts_of(const IndexBox& region, const std::vector<Holder>& holders, int owner,
                           std::vector<IndexBox>& missing) {
  std::vector<Part> parts;
  parts.reserve(4);
  missing = {region};
  for (const Holder& h : holders)
    if (h.owner == owner) take(h, h.trusted, missing, parts);
  for (const Holder& h : holders)
    if (h.owner != owner) take(h, h.cells, missing, parts);
  for (const Holder& h : holders)
    if (h.owner != owner) take(h, h.trusted, missing, parts);
  for (const Holder& h : holders) take(h, h.filled, missing, parts);
  return parts;
}

[[noreturn]] void fail_nesting(IntVec3 cell, const Level& coarse, const Level& fine,
                               const IndexBox& box) {
  throw std::logic_error(fmt::format(
      "level {} does not nest in level {}: to interpolate around the fine box ({}, {}, {}) to "
      "({}, {}, {}), coarse cell ({}, {}, {}) is needed, which no box of level {} holds or fills",
      fine.index, coarse.index, box.lower.x, box.lower.y, box.lower.z, box.upper.x, box.upper.y,
      box.upper.z, cell.x, cell.y, cell.z, coarse.index));
}

}  // namespace

FineRegions interface_ghosts(const Level& fine, int width, Arrays arrays) {
  const BoxFinder finder(cells_of(fine.boxes));
  IndexBox inside = fine.domain;
  for (int d = 0; d < 3; ++d)
    if (fine.periodic[d]) inside = inside.grown(d, fine.ghosts(width)[d], fine.ghosts(width)[d]);
  const std::vector<std::vector<IndexBox>> held = held_by_frames(fine, width, arrays);
  FineRegions regions;
  regions.reserve(fine.boxes.size());
  for (const GridBox& b : fine.boxes)
    regions.push_back(subtract(
        pieces_without_level(intersection(b.cells.grown(fine.ghosts(width)), inside), fine, finder),
        held[b.id]));
  return regions;
}

FineRegions new_cells(const Level& fine, const std::vector<GridBox>& earlier) {
  const BoxFinder finder(cells_of(earlier));
  FineRegions regions;
  regions.reserve(fine.boxes.size());
  std::vector<int> found;
  for (const GridBox& b : fine.boxes) {
    finder.find(b.cells, found);
    std::vector<IndexBox> holes;
    holes.reserve(found.size());
    for (const int n : found) holes.push_back(finder.boxes()[n]);
    regions.push_back(pieces_without(b.cells, std::move(holes), row_direction(fine.active)));
  }
  return regions;
}

InterpolationPlan::InterpolationPlan(const Level& coarse_level, int coarse_ghosts,
                                     const Level& fine_level, const FineRegions& regions,
                                     int this_rank)
    : coarse(without_boxes(coarse_level)),
      fine(without_boxes(fine_level)),
      geometry{fine_level.ratio, fine_level.active},
      rank(this_rank) {
  CoarseLevel coarse_boxes(coarse_level, coarse_ghosts, rank);
  const std::vector<int> fine_number = local_numbers(fine_level, rank);
  std::vector<Target> late;  // those that wait for messages
  for (std::size_t f = 0; f < fine_level.boxes.size(); ++f) {
    if (regions[f].empty()) continue;
    const GridBox& box = fine_level.boxes[f];
    IndexBox reach = regions[f].front();
    for (const IndexBox& r : regions[f]) reach = bounding(reach, r);
    const std::vector<Holder>& holders = coarse_boxes.holders(coarse_cells_of(reach));
    const bool sends_some =
        std::any_of(holders.begin(), holders.end(), [](const Holder& h) { return h.number >= 0; });
    if (box.owner != rank && !sends_some) continue;
    for (const IndexBox& region : regions[f]) {
      Target target{fine_number[f], region, coarse_cells_of(region), -1, {}, 0, 0};
      const bool waits = find_sources(target, box, holders);
      if (box.owner == rank) (waits ? late : targets).push_back(target);
    }
  }
  without_messages = targets.size();
  targets.insert(targets.end(), late.begin(), late.end());
  for (const Target& t : targets) {
    fine_cells += t.cells.volume();
    max_coarse_cells = std::max(max_coarse_cells, t.coarse.volume());
    coarse_cells_of_all += t.coarse.volume();
  }
}

IndexBox InterpolationPlan::coarse_cells_of(const IndexBox& cells) const {
  return coarsen(cells, geometry.ratio).grown(coarse.ghosts(1));
}

bool InterpolationPlan::find_sources(Target& target, const GridBox& box,
                                     const std::vector<Holder>& holders) {
  const bool mine = box.owner == rank;
  target.first_source = target.last_source = sources.size();
  for (const Holder& h : holders)
    if (h.owner == box.owner && h.trusted.contains(target.coarse)) {
      target.direct = h.number;
      target.shift = h.shift;
      return false;
    }
  std::vector<IndexBox> missing;
  bool waits = false;
  for (const Part& p : parts_of(target.coarse, holders, box.owner, missing)) {
    const Holder& h = *p.holder;
    if (mine) {
      sources.push_back({p.cells, h.number, h.shift, {}});
      if (h.number < 0) sources.back().piece = messages.add_receive(h.owner, p.cells.volume());
      waits = waits || h.number < 0;
    } else if (h.number >= 0) {
      sends.push_back(
          {h.number, p.cells.shifted(h.shift), messages.add_send(box.owner, p.cells.volume())});
    }
  }
  if (!missing.empty()) fail_nesting(missing.front().lower, coarse, fine, box.cells);
  target.last_source = sources.size();
  return waits;
}

}  // namespace sluice
