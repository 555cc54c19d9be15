// What must hold between the numbers of a grid: boxes that exist, cells that can be counted.
#include <fmt/format.h>

#include <array>
#include <cmath>

#include "framework/deck/faults.hpp"
#include "framework/deck/format/framework_schema.hpp"
#include "framework/deck/rule_tools.hpp"

namespace sluice {
namespace {

// More cells than this cannot be meant: 40 doubles a cell would take 32 TB.
constexpr double max_cells = 1e11;

// Cells per direction of a box, from its resolution or the level's spacing; 0: unknown or faulty.
std::array<double, 3> cells_of(const DeckNode& level, const DeckNode& box) {
  const auto resolution = int_vector_of(&box, "resolution");
  if (resolution) return {double(resolution->x), double(resolution->y), double(resolution->z)};
  const auto spacing = vector_of(&level, "spacing");
  const auto low = vector_of(&box, "lower");
  const auto high = vector_of(&box, "upper");
  if (!spacing || !low || !high) return {};
  std::array<double, 3> cells{};
  for (int d = 0; d < 3; ++d) {
    cells[d] = std::round(((*high)[d] - (*low)[d]) / (*spacing)[d]);
  }
  return cells;
}

bool check_corners(const DeckNode& box, std::vector<Fault>& faults) {
  const auto low = vector_of(&box, "lower");
  const auto high = vector_of(&box, "upper");
  if (!low || !high) return false;
  bool good = true;
  for (int d = 0; d < 3; ++d) {
    if ((*low)[d] < (*high)[d]) continue;
    good = false;
    add_error(faults, box.child("upper")->where,
              fmt::format("the box is {} in {}: lower {}, upper {}",
                          (*low)[d] == (*high)[d] ? "flat" : "inverted", direction_names[d],
                          (*low)[d], (*high)[d]),
              "upper must be greater than lower in every direction; a flat direction has one cell");
  }
  return good;
}

void check_spacing(const DeckNode& level, const DeckNode& box, std::vector<Fault>& faults) {
  const bool spacing = level.child("spacing") != nullptr;
  const bool resolution = box.child("resolution") != nullptr;
  if (spacing && resolution) {
    add_error(faults, box.child("resolution")->where,
              fmt::format("<resolution> contradicts <spacing> of the level at {}",
                          to_string(level.child("spacing")->where)),
              "keep one of them");
  } else if (!spacing && !resolution) {
    add_error(faults, box.where, "<Box> has no <resolution>, and its level no <spacing>",
              "give the number of cells, as <resolution>[100,1,1]</resolution>");
  }
}

void check_patches(const DeckNode& box, const std::array<double, 3>& cells,
                   std::vector<Fault>& faults) {
  const auto patches = int_vector_of(&box, "patches");
  if (!patches) return;
  for (int d = 0; d < 3; ++d) {
    const double n = cells[d];
    if (n < 1 || (*patches)[d] <= n) continue;
    add_error(faults, box.child("patches")->where,
              fmt::format("{} patches in {}, but only {} cell{}", (*patches)[d], direction_names[d],
                          n, n == 1 ? "" : "s"));
  }
}

}  // namespace

void check_boxes(const DeckNode& root, std::vector<Fault>& faults) {
  const DeckNode* grid = root.child("Grid");
  if (grid == nullptr) return;
  double total = 0;
  const DeckNode* largest = nullptr;
  for (const DeckNode* level : grid->all("Level")) {
    bool told = false;  // of a spacing that is too large: once a level
    for (const DeckNode* box : level->all("Box")) {
      check_spacing(*level, *box, faults);
      const bool corners = check_corners(*box, faults);
      const auto cells = cells_of(*level, *box);
      const bool zero = corners && (cells[0] < 1 || cells[1] < 1 || cells[2] < 1);
      if (zero && !told && box->child("resolution") == nullptr && vector_of(level, "spacing")) {
        told = true;
        add_error(faults, level->child("spacing")->where,
                  "the spacing is larger than the box: there would be no cells");
      }
      check_patches(*box, cells, faults);
      total += cells[0] * cells[1] * cells[2];
      largest = box;
    }
  }
  if (total > max_cells && largest != nullptr) {
    add_error(faults, largest->where, fmt::format("the grid would have {:.3g} cells", total),
              fmt::format("at most {:.0g} are allowed", max_cells));
  }
}

void check_periodicity(const DeckNode& root, std::vector<Fault>& faults) {
  const DeckNode* grid = root.child("Grid");
  if (grid == nullptr) return;
  for (const DeckNode* level : grid->all("Level")) {
    const auto periodic = int_vector_of(level, "periodic");
    if (!periodic) continue;
    for (const DeckNode* box : level->all("Box")) {
      const auto extra = int_vector_of(box, "extraCells");
      if (!extra) continue;
      for (int d = 0; d < 3; ++d) {
        if ((*periodic)[d] == 0 || (*extra)[d] == 0) continue;
        add_error(faults, box->child("extraCells")->where,
                  fmt::format("extraCells {} in {}, a periodic direction", (*extra)[d],
                              direction_names[d]),
                  "a periodic direction has no boundary: write 0 there");
      }
    }
  }
}

}  // namespace sluice
