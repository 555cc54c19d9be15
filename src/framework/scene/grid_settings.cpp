// Reading and checking the deck's <Grid>.
#include "framework/scene/grid_settings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "framework/scene/deck_values.hpp"
#include "framework/scene/directions.hpp"

namespace sluice {

namespace {

constexpr double same_spacing = 1e-10;      // relative, between the boxes of a level
constexpr double on_node = 1e-6;            // cells
constexpr double integral_ratio = 1e-5;     // of refinement ratios
constexpr double largest_extent = 1 << 30;  // cells a direction
constexpr double largest_level = 1e11;      // cells
constexpr double max_patches = 1e6;         // of one box

// Where the deck gives the cells of a box: one of the two, in the box or in the level around it.
struct CellSource {
  const DeckNode* resolution = nullptr;
  const DeckNode* spacing = nullptr;

  const DeckNode& node() const { return resolution != nullptr ? *resolution : *spacing; }
};

// Nothing when a fault was found.
std::optional<CellSource> source_of_cells(const DeckNode& node, const DeckNode& level,
                                          std::vector<Fault>& faults) {
  CellSource source{node.child("resolution"), node.child("spacing")};
  if (source.resolution == nullptr && source.spacing == nullptr)
    source = {level.child("resolution"), level.child("spacing")};
  if ((source.resolution == nullptr) != (source.spacing == nullptr)) return source;
  add_error(faults, node.where,
            source.resolution == nullptr
                ? "a box needs a <resolution>, or its level a <spacing>"
                : "a box takes either a <resolution> or a <spacing>, not both");
  return std::nullopt;
}

// Makes the number of cells in direction d whole, and the spacing what it then is; false when it is
// out of range or far from a whole number.
bool settle_cells(int d, const CellSource& source, const BoxSettings& box, double& cells,
                  double& spacing, std::vector<Fault>& faults) {
  const double whole = std::round(cells), size = box.upper[d] - box.lower[d];
  if (!(whole >= 1 && whole <= largest_extent)) {
    add_error(faults, source.node().where,
              fmt::format("box: {} cells in direction {}; there must be 1 to 2^30", cells,
                          axis_letter[d]));
    return false;
  }
  if (std::abs(cells - whole) > on_node * whole && source.resolution == nullptr && cells > 1) {
    const double fit = std::floor(cells);
    add_warning(faults, source.node().where,
                fmt::format("box: {} cells in direction {}; it ends with the last complete "
                            "cell, at {:g} in place of {:g}",
                            cells, axis_letter[d], box.lower[d] + fit * spacing, box.upper[d]),
                "fit the spacing to upper - lower");
    cells = fit;
    return true;
  }
  if (std::abs(cells - whole) > on_node * whole) {
    add_error(faults, source.node().where,
              fmt::format("box: {} cells in direction {} is not a whole number; fit the spacing "
                          "to upper - lower = {}",
                          cells, axis_letter[d], size));
    return false;
  }
  cells = whole;
  if (source.resolution != nullptr) spacing = size / whole;
  return true;
}

// Cells a direction of a box as the deck asks for them; nothing when a fault was found.
std::optional<Vec3> cells_of(const DeckNode& node, const DeckNode& level, const BoxSettings& box,
                             Vec3& spacing, std::vector<Fault>& faults) {
  const Vec3 size = box.upper - box.lower;
  for (int d = 0; d < 3; ++d)
    if (!(size[d] > 0) || !std::isfinite(size[d])) {
      add_error(faults, node.where,
                fmt::format("box: upper {} is not above lower {} in direction {}", box.upper[d],
                            box.lower[d], axis_letter[d]));
      return std::nullopt;
    }
  const std::optional<CellSource> source = source_of_cells(node, level, faults);
  if (!source) return std::nullopt;
  Vec3 cells{};
  if (source->resolution != nullptr) {
    cells = source->resolution->as_vector();
  } else {
    spacing = source->spacing->as_vector();
    for (int d = 0; d < 3; ++d)
      cells[d] = spacing[d] > 0 ? size[d] / spacing[d] : std::numeric_limits<double>::infinity();
  }
  for (int d = 0; d < 3; ++d)
    if (!settle_cells(d, *source, box, cells[d], spacing[d], faults)) return std::nullopt;
  if (cells.x * cells.y * cells.z > largest_level) {
    add_error(faults, source->node().where,
              fmt::format("box: {:.3g} cells; more than {:.0e} are refused",
                          cells.x * cells.y * cells.z, largest_level));
    return std::nullopt;
  }
  return cells;
}

void read_patches(const DeckNode& node, BoxSettings& box, std::vector<Fault>& faults) {
  box.patches = int_vector_or(node, "patches", {1, 1, 1});
  if (const DeckNode* automatic = node.child("autoPatch")) {
    box.auto_patch = static_cast<int>(automatic->as_real());
    if (box.auto_patch < 1)
      add_error(faults, automatic->where, "autoPatch: patches per rank must be at least 1");
    if (const std::optional<Vec3> flatten = vector_attribute(*automatic, "flatten"))
      for (int d = 0; d < 3; ++d) box.flatten[d] = (*flatten)[d] != 0;
  }
  for (int d = 0; d < 3; ++d)
    if (box.patches[d] < 1)
      add_error(faults, node.where,
                fmt::format("box: {} patches in direction {}; there must be at least 1",
                            box.patches[d], axis_letter[d]));
  const double count = 1.0 * box.patches.x * box.patches.y * box.patches.z;
  if (count > max_patches || box.auto_patch > max_patches)
    add_error(faults, node.where,
              fmt::format("box: {:.3g} patches; more than {:.0e} are refused",
                          std::max(count, 1.0 * box.auto_patch), max_patches));
}

struct RawBox {
  BoxSettings box;
  Vec3 cells{}, spacing{};
};

std::optional<RawBox> read_box(const DeckNode& node, const DeckNode& level,
                               std::vector<Fault>& faults) {
  std::optional<RawBox> result;
  collect(faults, node.where, [&] {
    RawBox raw;
    raw.box.where = node.where;
    raw.box.label = node.attribute("label").value_or("");
    raw.box.lower = node.vector("lower");
    raw.box.upper = node.vector("upper");
    raw.box.extra_cells = int_vector_or(node, "extraCells", {0, 0, 0});
    read_patches(node, raw.box, faults);
    const std::optional<Vec3> cells = cells_of(node, level, raw.box, raw.spacing, faults);
    if (!cells) return;
    raw.cells = *cells;
    for (int d = 0; d < 3; ++d)
      if (const double end = raw.box.lower[d] + raw.cells[d] * raw.spacing[d];
          std::abs(end - raw.box.upper[d]) > on_node * raw.spacing[d])
        raw.box.upper[d] = end;
    for (int d = 0; d < 3; ++d)
      if (raw.box.patches[d] > raw.cells[d])
        add_error(faults, node.where,
                  fmt::format("box: {} patches but only {} cells in direction {}",
                              raw.box.patches[d], raw.cells[d], axis_letter[d]));
    result = raw;
  });
  return result;
}

// Index box of a deck box; its corners must lie on nodes of the level.
bool place(RawBox& raw, const LevelSettings& level, Vec3 anchor, std::vector<Fault>& faults) {
  for (int d = 0; d < 3; ++d) {
    if (std::abs(raw.spacing[d] - level.spacing[d]) > same_spacing * level.spacing[d]) {
      add_error(faults, raw.box.where,
                fmt::format("box: spacing {} in direction {} differs from {} of the level's first "
                            "box; all boxes of a level share one spacing",
                            raw.spacing[d], axis_letter[d], level.spacing[d]));
      return false;
    }
    const double low = (raw.box.lower[d] - anchor[d]) / level.spacing[d];
    const double high = (raw.box.upper[d] - anchor[d]) / level.spacing[d];
    for (const double x : {low, high})
      if (std::abs(x) > largest_extent ||
          std::abs(x - std::round(x)) > on_node * std::max(1.0, std::abs(x))) {
        add_error(faults, raw.box.where,
                  fmt::format("box: corner at node {} in direction {} is not on a node of the "
                              "level (anchor {}, spacing {})",
                              x, axis_letter[d], anchor[d], level.spacing[d]));
        return false;
      }
    raw.box.cells.lower[d] = static_cast<int>(std::lround(low));
    raw.box.cells.upper[d] = static_cast<int>(std::lround(high));
  }
  return true;
}

void check_overlap(const LevelSettings& level, std::vector<Fault>& faults) {
  for (std::size_t i = 0; i < level.boxes.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (!intersection(level.boxes[i].cells, level.boxes[j].cells).empty())
        add_error(faults, level.boxes[i].where,
                  fmt::format("box overlaps the box at {}; boxes of a level may only touch",
                              to_string(level.boxes[j].where)));
}

IndexBox bounding_cells(const LevelSettings& level) {
  IndexBox all = level.boxes.front().cells;
  for (const BoxSettings& b : level.boxes) all = bounding(all, b.cells);
  return all;
}

std::int64_t volume_of(const LevelSettings& level, const IndexBox& window) {
  std::int64_t n = 0;
  for (const BoxSettings& b : level.boxes) n += intersection(b.cells, window).volume();
  return n;
}

// The refinement ratio against the coarser level, and whether the finer one lies well inside it.
void nest(LevelSettings& fine, const LevelSettings& coarse, std::vector<Fault>& faults) {
  for (int d = 0; d < 3; ++d) {
    const double ratio = coarse.spacing[d] / fine.spacing[d];
    const double whole = std::round(ratio);
    if (!(whole >= 1 && whole <= 1024) || std::abs(ratio - whole) > integral_ratio) {
      add_error(faults, fine.where,
                fmt::format("refinement ratio {} in direction {} is not a whole number", ratio,
                            axis_letter[d]));
      return;
    }
    fine.ratio[d] = static_cast<int>(whole);
  }
  for (const BoxSettings& b : fine.boxes) {
    IndexBox covered;
    for (int d = 0; d < 3; ++d) {
      const int r = fine.ratio[d];
      if (b.cells.lower[d] % r != 0 || b.cells.upper[d] % r != 0) {
        add_error(faults, b.where,
                  fmt::format("box: its edges in direction {} are not on nodes of the coarser "
                              "level (ratio {})",
                              axis_letter[d], r));
        return;
      }
      covered.lower[d] = b.cells.lower[d] / r;
      covered.upper[d] = b.cells.upper[d] / r;
    }
    if (volume_of(coarse, covered) != covered.volume())
      add_error(faults, b.where, "box: it extends beyond the next coarser level");
  }
}

std::array<bool, 3> read_periodic(const DeckNode& level) {
  const IntVec3 p = int_vector_or(level, "periodic", {0, 0, 0});
  return {p.x != 0, p.y != 0, p.z != 0};
}

// Boxes of one level, without indices, and the level's spacing.
std::vector<RawBox> read_level(const DeckNode& node, LevelSettings& level,
                               std::vector<Fault>& faults) {
  level.where = node.where;
  collect(faults, node.where, [&] { level.periodic = read_periodic(node); });
  const std::vector<const DeckNode*> nodes = node.all("Box");
  if (nodes.empty()) add_error(faults, node.where, "a level needs at least one <Box>");
  std::vector<RawBox> boxes;
  for (const DeckNode* b : nodes)
    if (std::optional<RawBox> raw = read_box(*b, node, faults)) boxes.push_back(std::move(*raw));
  if (!boxes.empty()) level.spacing = boxes.front().spacing;
  if (boxes.size() != nodes.size()) boxes.clear();  // a fault was reported
  return boxes;
}

}  // namespace

GridSettings read_grid_settings(const DeckNode& grid, std::vector<Fault>& faults) {
  GridSettings g;
  g.where = grid.where;
  const std::vector<const DeckNode*> nodes = grid.all("Level");
  if (nodes.empty()) add_error(faults, grid.where, "<Grid> needs at least one <Level>");
  bool good = true;
  for (const DeckNode* node : nodes) {
    LevelSettings level;
    std::vector<RawBox> boxes = read_level(*node, level, faults);
    if (boxes.empty()) good = false;
    if (!good) continue;
    if (g.levels.empty()) {
      g.anchor = boxes.front().box.lower;
      for (const RawBox& b : boxes)
        for (int d = 0; d < 3; ++d) g.anchor[d] = std::min(g.anchor[d], b.box.lower[d]);
    }
    for (RawBox& b : boxes) {
      if (!place(b, level, g.anchor, faults)) good = false;
      level.boxes.push_back(b.box);
    }
    if (good) check_overlap(level, faults);
    if (good && !g.levels.empty()) nest(level, g.levels.back(), faults);
    if (good && g.levels.empty()) {
      const IndexBox all = bounding_cells(level);
      if (volume_of(level, all) < all.volume())
        add_warning(faults, level.where,
                    "the boxes of the coarsest level leave gaps: cells there are walls",
                    "a rectangular block has no gaps");
    }
    if (!g.levels.empty()) level.periodic = g.levels.front().periodic;
    g.levels.push_back(std::move(level));
  }
  if (!good) g.levels.clear();
  return g;
}

}  // namespace sluice
