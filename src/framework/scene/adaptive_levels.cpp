// Levels that a regridder may make, and what every finer level must obey.
#include "framework/scene/adaptive_levels.hpp"
#include "framework/scene/directions.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "framework/grid/box_list.hpp"
#include "framework/scene/deck_values.hpp"

namespace sluice {

namespace {

constexpr int smallest_tile = 4;              // cells, in a direction that has as many
constexpr std::int64_t max_extent = 1 << 30;  // cells a direction of the finest level
constexpr double max_flags = 1e10;            // cells of the finest level that is flagged: 1.2 GB

bool good_ratio(int ratio) {
  return ratio == 1 || ratio == 2 || ratio == 4;
}

// The ratio between a level and the next finer one; false when a fault was found. A level that a
// deck lays out itself may be no finer.
bool check_ratio(IntVec3& ratio, std::size_t fine, const std::array<bool, 3>& active, bool by_hand,
                 const Location& where, std::vector<Fault>& faults) {
  bool refines = false;
  for (int d = 0; d < 3; ++d) {
    if (!active[d]) {
      if (ratio[d] != 1)
        add_warning(
            faults, where,
            fmt::format(
                "refinement ratio {} in direction {}, which is inactive in this run; read as 1",
                ratio[d], axis_letter[d]));
      ratio[d] = 1;
      continue;
    }
    if (!good_ratio(ratio[d])) {
      add_error(faults, where,
                fmt::format("refinement ratio {} in direction {} between levels {} and {}; it must "
                            "be 1, 2 or 4",
                            ratio[d], axis_letter[d], fine - 1, fine),
                ratio[d] > 4 ? "use several levels to reach it" : "use 2 or 4");
      return false;
    }
    refines = refines || ratio[d] > 1;
  }
  if (!refines)
    (by_hand ? add_warning : add_error)(
        faults, where,
        fmt::format(
            "level {} refines no active direction: its ratio to level {} is 1 in each of them",
            fine, fine - 1),
        "use 2 or 4 in at least one direction");
  return refines || by_hand;
}

// A region of a periodic level reaches around it: the parts as they lie inside `domain`.
std::vector<IndexBox> wrapped(const IndexBox& region, const IndexBox& domain,
                              const std::array<bool, 3>& periodic) {
  std::vector<IndexBox> parts;
  const IntVec3 n = domain.size();
  for_each_cell({IntVec3::all(-1), IntVec3::all(2)}, [&](IntVec3 image) {
    for (int d = 0; d < 3; ++d)
      if (image[d] != 0 && !periodic[d]) return;
    const IndexBox part = intersection(region.shifted(image * n), domain);
    if (!part.empty()) parts.push_back(part);
  });
  return parts;
}

void check_margin(const GridSettings& grid, std::size_t level, std::vector<Fault>& faults) {
  const LevelSettings& fine = grid.levels[level];
  const LevelSettings& coarse = grid.levels[level - 1];
  std::vector<IndexBox> cells;
  for (const BoxSettings& b : coarse.boxes) cells.push_back(b.cells);
  const BoxFinder finder(cells);
  const IndexBox domain = domain_of(grid, level - 1);
  for (const BoxSettings& b : fine.boxes) {
    const IndexBox around = coarsen(b.cells, fine.ratio).grown(IntVec3::all(1));
    for (const IndexBox& part : wrapped(around, domain, coarse.periodic)) {
      if (finder.covers(part)) continue;
      add_error(faults, b.where,
                fmt::format("box: it touches the edge of level {}; at least one cell of that level "
                            "must surround it except at the boundary of the domain",
                            level - 1),
                "make the coarser level larger or this box smaller");
      break;
    }
  }
}

const IntVec3& entry(const std::vector<IntVec3>& list, std::size_t fine) {
  return list[std::min(fine, list.size()) - 1];
}

// The tile of a level; false when a fault was found.
bool check_tile(IntVec3& tile, IntVec3 ratio, IntVec3 cells, std::size_t level,
                const std::array<bool, 3>& active, const Location& where,
                std::vector<Fault>& faults) {
  for (int d = 0; d < 3; ++d) {
    if (!active[d]) {
      tile[d] = 1;
      continue;
    }
    if (tile[d] < smallest_tile && tile[d] < cells[d]) {
      add_error(faults, where,
                fmt::format("a tile of {} cell{} in direction {} for level {}; it must have at "
                            "least {}",
                            tile[d], tile[d] == 1 ? "" : "s", axis_letter[d], level, smallest_tile),
                "8 or more cells per direction are recommended because of the ghost cells");
      return false;
    }
    if (tile[d] % ratio[d] != 0) {
      const int whole = (tile[d] / ratio[d] + 1) * ratio[d];
      add_warning(
          faults, where,
          fmt::format("a tile of {} cells in direction {} for level {}, where the refinement ratio "
                      "is {}: it is replaced by tiles of whole coarse cells, of {}",
                      tile[d], axis_letter[d], level, ratio[d], whole),
          fmt::format("use {}", whole));
      tile[d] = whole;
    }
  }
  return true;
}

bool check_extent(IntVec3 coarse_cells, IntVec3 ratio, const Location& where,
                  std::vector<Fault>& faults) {
  for (int d = 0; d < 3; ++d) {
    if (static_cast<std::int64_t>(coarse_cells[d]) * ratio[d] <= max_extent) continue;
    add_error(faults, where,
              fmt::format("the finest level would have more than 2^30 cells in direction {}",
                          axis_letter[d]),
              "use fewer levels");
    return false;
  }
  return true;
}

bool check_flags(IntVec3 cells, const Location& where, std::vector<Fault>& faults) {
  const double count = 1.0 * cells.x * cells.y * cells.z;
  if (count <= max_flags) return true;
  add_error(
      faults, where,
      fmt::format(
          "a domain of {:.3g} cells is to be flagged for refinement; at most {:.0e} are allowed",
          count, max_flags),
      "use fewer levels");
  return false;
}

void warn_of_surplus(const char* what, std::size_t count, int finer, const Location& where,
                     std::vector<Fault>& faults) {
  if (static_cast<int>(count) > finer)
    add_warning(faults, where,
                fmt::format("{} {} for {} finer level{}; the last ones are not used", count, what,
                            finer, finer == 1 ? "" : "s"),
                "max_levels counts the coarsest level too");
}

}  // namespace

IndexBox domain_of(const GridSettings& grid, std::size_t level) {
  const LevelSettings& coarsest = grid.levels.front();
  IndexBox domain = coarsest.boxes.front().cells;
  for (const BoxSettings& b : coarsest.boxes) domain = bounding(domain, b.cells);
  for (std::size_t l = 1; l <= level; ++l) domain = refine(domain, grid.levels[l].ratio);
  return domain;
}

void check_static_levels(const GridSettings& grid, const std::array<bool, 3>& active,
                         std::vector<Fault>& faults) {
  for (std::size_t l = 1; l < grid.levels.size(); ++l) {
    IntVec3 ratio = grid.levels[l].ratio;
    if (!check_ratio(ratio, l, active, true, grid.levels[l].where, faults) ||
        !check_extent(domain_of(grid, l - 1).size(), ratio, grid.levels[l].where, faults))
      return;
    // All cells of the coarsest level exist, so nothing can be missing around the next.
    if (l >= 2) check_margin(grid, l, faults);
  }
}

std::vector<IntVec3> add_adaptive_levels(const AdaptiveLevels& levels,
                                         const std::array<bool, 3>& active, GridSettings& grid,
                                         std::vector<Fault>& faults) {
  const int finer = levels.max_levels - 1;
  warn_of_surplus("refinement ratios", levels.ratios.size(), finer, levels.ratio_where, faults);
  warn_of_surplus("tile sizes", levels.tiles.size(), finer, levels.tile_where, faults);
  std::vector<IntVec3> tiles{IntVec3::all(1)};
  std::vector<LevelSettings> added;
  IndexBox domain = domain_of(grid, 0);
  Vec3 spacing = grid.levels.front().spacing;
  std::vector<Fault> mine;
  for (std::size_t l = 1; l <= static_cast<std::size_t>(finer); ++l) {
    IntVec3 ratio = entry(levels.ratios, l), tile = entry(levels.tiles, l);
    if (!check_ratio(ratio, l, active, false, levels.ratio_where, mine) ||
        !check_extent(domain.size(), ratio, levels.ratio_where, mine) ||
        !check_flags(domain.size(), levels.ratio_where, mine))
      break;
    domain = refine(domain, ratio);
    if (!check_tile(tile, ratio, domain.size(), l, active, levels.tile_where, mine)) break;
    LevelSettings level;
    level.ratio = ratio;
    for (int d = 0; d < 3; ++d) spacing[d] /= ratio[d];
    level.spacing = spacing;
    level.periodic = grid.levels.front().periodic;
    level.where = levels.ratio_where;
    added.push_back(std::move(level));
    tiles.push_back(tile);
  }
  const bool good = !any_error(mine);
  for (Fault& f : mine) {
    // One list entry may hold for several levels: what it brings is said once.
    const bool known = std::any_of(faults.begin(), faults.end(), [&](const Fault& other) {
      return other.message == f.message && to_string(other.where) == to_string(f.where);
    });
    if (!known) faults.push_back(std::move(f));
  }
  if (!good) return {};
  grid.levels.insert(grid.levels.end(), added.begin(), added.end());
  return tiles;
}

}  // namespace sluice
