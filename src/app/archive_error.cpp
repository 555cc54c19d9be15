#include "app/archive_error.hpp"

#include <fmt/format.h>

#include <map>

#include "framework/base/error.hpp"

namespace sluice {
namespace {

// Cells of `level` that lie under the next finer one.
bool covered(const Grid& grid, std::size_t level, IntVec3 c) {
  if (level + 1 >= grid.levels.size()) return false;
  const Level& fine = grid.levels[level + 1];
  const IntVec3 low = c * fine.ratio;
  for (const GridBox& box : fine.boxes) {
    if (box.cells.contains(low)) return true;
  }
  return false;
}

struct CellRequest {
  const std::string& variable;
  int component, material, level;
};

// Of one material, in the order of for_each_cell.
std::vector<double> values_of(const ArchiveStep& step, const CellRequest& asked,
                              const IndexBox& cells) {
  const FieldInfo* field = step.find(asked.variable, asked.material, asked.level);
  if (!field || field->centring != Centring::cell || asked.component >= field->components()) {
    throw InputError(fmt::format(
        "{}: no cell variable '{}' with component {} of material {} on level {}; save it with "
        "<save label=\"{}\"/>",
        step.folder().string(), asked.variable, asked.component, asked.material, asked.level,
        asked.variable));
  }
  const DenseField values = step.read(*field, cells);
  std::vector<double> out;
  for_each_cell(cells, [&](IntVec3 c) { out.push_back(values.at(c, asked.component)); });
  return out;
}

// Of all materials together: the density is their sum, the velocity their mean by mass.
std::vector<double> mixture_values(const ArchiveStep& step, CellRequest asked,
                                   const IndexBox& cells) {
  if (asked.variable == "press_CC" || asked.variable == "vol_frac_CC")
    return values_of(step, asked, cells);
  const bool velocity = asked.variable == "vel_CC";
  if (!velocity && asked.variable != "rho_CC") {
    throw InputError(fmt::format(
        "a run of several materials has no exact '{}'; known are rho_CC, vel_CC (of the mixture), "
        "press_CC, vol_frac_CC",
        asked.variable));
  }
  std::vector<double> mass, sum;
  for (asked.material = 0;; ++asked.material) {
    if (asked.material > 0 && !step.find("rho_CC", asked.material, asked.level)) break;
    const auto rho = values_of(step, {"rho_CC", 0, asked.material, asked.level}, cells);
    const auto factor = velocity ? values_of(step, asked, cells) : std::vector<double>{};
    mass.resize(rho.size());
    sum.resize(rho.size());
    for (std::size_t n = 0; n < rho.size(); ++n) {
      mass[n] += rho[n];
      if (velocity && rho[n] > 0) sum[n] += rho[n] * factor[n];
    }
  }
  if (!velocity) return mass;
  for (std::size_t n = 0; n < sum.size(); ++n) sum[n] /= mass[n];
  return sum;
}

}  // namespace

std::optional<DeckReference> reference_of_deck(const DeckNode& root) {
  const DeckNode* node = root.find("Meta/exact_solution");
  if (!node) return std::nullopt;
  std::map<std::string, std::string> values;
  for (const auto& child : node->children) values[child->name] = child->text;
  DeckReference reference;
  try {
    reference.solution =
        exact::make_exact_solution({node->attribute("type").value_or(""), std::move(values)});
  } catch (const InputError& fault) {
    throw InputError(fmt::format("{}: {}", to_string(node->where), fault.what()));
  }
  if (const DeckNode* heat = root.find("MaterialProperties/ICE/material/specific_heat")) {
    reference.specific_heat = heat->as_real();
  }
  return reference;
}

std::optional<DeckReference> reference_of_archive(const Archive& archive) {
  const Deck deck = read_deck((archive.folder() / "input.xml").string());
  if (!deck.root) return std::nullopt;
  return reference_of_deck(*deck.root);
}

exact::ErrorNorms archive_error(const ArchiveStep& step, const DeckReference& reference,
                                const std::string& variable, int component, int material) {
  const bool mixture = reference.solution->materials() > 1;
  const Grid& grid = step.grid();
  const double time = step.info().time;
  std::vector<double> computed, exact, volumes;
  for (std::size_t level = 0; level < grid.levels.size(); ++level) {
    for (const GridBox& box : grid.levels[level].boxes) {
      const CellRequest request{variable, component, material, static_cast<int>(level)};
      const std::vector<double> values =
          mixture ? mixture_values(step, request, box.cells) : values_of(step, request, box.cells);
      std::size_t n = 0;
      for_each_cell(box.cells, [&](IntVec3 c) {
        const double value = values[n++];
        if (covered(grid, level, c)) return;
        const exact::State state = reference.solution->at(grid.levels[level].centre(c), time);
        computed.push_back(value);
        exact.push_back(variable == "vol_frac_CC" ? (state.material == material ? 1.0 : 0.0)
                                                  : exact::exact_value(state, variable, component,
                                                                       reference.specific_heat));
        volumes.push_back(grid.levels[level].cell_volume());
      });
    }
  }
  if (grid.levels.size() == 1) volumes.clear();
  return exact::error_norms(computed, exact, volumes);
}

}  // namespace sluice
