#include "app/loading/deck_scaling.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

namespace sluice {
namespace {

// Moduli of constitutive models, as decks call them (Pa).
constexpr std::array<std::string_view, 8> moduli = {"shear_modulus",
                                                    "bulk_modulus",
                                                    "youngs_modulus",
                                                    "initial_shear_modulus",
                                                    "lame_modulus",
                                                    "elastic_modulus",
                                                    "C10",
                                                    "mu"};

bool is_modulus(const DeckNode& node) {
  return std::find(moduli.begin(), moduli.end(), node.name) != moduli.end() && !node.defaulted &&
         node.children.empty();
}

// visit(path, node) of each node below one, where `path` selects by number among tags of a name.
template <class F>
void for_each_node(const DeckNode& node, const std::string& path, F&& visit) {
  for (const auto& child : node.children) {
    int number = 0;  // from 1 on, among its like
    for (const DeckNode* like : node.all(child->name)) {
      ++number;
      if (like == child.get()) break;
    }
    const std::string here =
        fmt::format("{}{}{}[{}]", path, path.empty() ? "" : "/", child->name, number);
    visit(here, *child);
    for_each_node(*child, here, visit);
  }
}

// PATH=VALUE of each tag below `block` that is `chosen`, its numbers times the factor.
template <class Chosen>
std::vector<std::string> scaled_below(const DeckNode& root, const std::string& block, double factor,
                                      Chosen&& chosen) {
  std::vector<std::string> overrides;
  for_each_node(root, "", [&](const std::string& path, const DeckNode& node) {
    if (!path.starts_with(block) || !chosen(node)) return;
    const std::vector<double> values = node.as_reals();
    std::string text;
    for (const double value : values)
      text += fmt::format("{}{:.17g}", text.empty() ? "" : ", ", factor * value);
    if (values.size() > 1) text = "[" + text + "]";
    overrides.push_back(path + "=" + text);
  });
  return overrides;
}

constexpr const char* solids = "MaterialProperties[1]/MPM[1]/";
constexpr const char* exchange = "MaterialProperties[1]/exchange_properties[1]/";

std::vector<std::string> scaled_moduli(const DeckNode& root, double factor) {
  return scaled_below(root, solids, factor, is_modulus);
}

std::vector<std::string> scaled_exchange(const DeckNode& root, double factor) {
  return scaled_below(root, exchange, factor, [](const DeckNode& node) {
    if (node.name != "momentum" || node.text.empty()) return false;
    const std::vector<double> values = node.as_reals();
    return std::any_of(values.begin(), values.end(), [](double k) { return k > 0; });
  });
}

IntVec3 scaled_cells(IntVec3 cells, double factor) {
  for (int d = 0; d < 3; ++d)
    if (cells[d] > 1) cells[d] = std::max(1, static_cast<int>(std::lround(factor * cells[d])));
  return cells;
}

}  // namespace

std::vector<std::string> step_overrides(const DeckNode& root, double factor) {
  const DeckNode* multiplier = root.find("Time/timestep_multiplier");
  const double now = multiplier == nullptr ? 1 : multiplier->as_real();
  return {fmt::format("Time/timestep_multiplier={:.17g}", factor * now)};
}

IntVec3 cells_of_deck(const DeckNode& root) {
  const DeckNode* level = root.find("Grid/Level");
  if (level == nullptr) return {};
  Vec3 lower, upper, spacing;
  bool first = true;
  for (const DeckNode* box : level->all("Box")) {
    const Vec3 low = box->vector("lower"), high = box->vector("upper");
    for (int d = 0; d < 3; ++d) {
      lower[d] = first ? low[d] : std::min(lower[d], low[d]);
      upper[d] = first ? high[d] : std::max(upper[d], high[d]);
    }
    if (const DeckNode* n = box->child("resolution"); n != nullptr && first) {
      const IntVec3 cells = n->as_int_vector();
      for (int d = 0; d < 3; ++d) spacing[d] = (high[d] - low[d]) / cells[d];
    }
    first = false;
  }
  if (const DeckNode* written = level->child("spacing")) spacing = written->as_vector();
  IntVec3 cells;
  for (int d = 0; d < 3; ++d)
    cells[d] =
        spacing[d] > 0 ? static_cast<int>(std::lround((upper[d] - lower[d]) / spacing[d])) : 0;
  return cells;
}

std::vector<std::string> resolution_overrides(const DeckNode& root, double factor) {
  std::vector<std::string> overrides;
  const DeckNode* grid = root.find("Grid");
  if (grid == nullptr) return overrides;
  const IntVec3 cells = cells_of_deck(root);
  int number = 0;
  for (const DeckNode* level : grid->all("Level")) {
    const std::string path = fmt::format("Grid/Level[{}]/", ++number);
    if (const DeckNode* spacing = level->child("spacing"); spacing != nullptr) {
      Vec3 h = spacing->as_vector();
      for (int d = 0; d < 3; ++d)
        if (cells[d] > 1) h[d] /= factor;
      overrides.push_back(fmt::format("{}spacing=[{:.17g},{:.17g},{:.17g}]", path, h.x, h.y, h.z));
    }
    int box_number = 0;
    for (const DeckNode* box : level->all("Box")) {
      ++box_number;
      if (box->child("resolution") == nullptr) continue;
      const IntVec3 n = scaled_cells(box->int_vector("resolution"), factor);
      overrides.push_back(
          fmt::format("{}Box[{}]/resolution=[{},{},{}]", path, box_number, n.x, n.y, n.z));
    }
  }
  return overrides;
}

std::string stiffness_name(const DeckNode& root) {
  if (!scaled_moduli(root, 1).empty()) return "moduli of the solids";
  if (!scaled_exchange(root, 1).empty()) return "exchange of momentum";
  return {};
}

std::vector<std::string> stiffness_overrides(const DeckNode& root, double factor) {
  auto overrides = scaled_moduli(root, factor);
  return overrides.empty() ? scaled_exchange(root, factor) : overrides;
}

}  // namespace sluice
