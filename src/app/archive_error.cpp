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
  const Grid& grid = step.grid();
  const double time = step.info().time;
  std::vector<double> computed, exact, volumes;
  for (std::size_t level = 0; level < grid.levels.size(); ++level) {
    const FieldInfo* field = step.find(variable, material, static_cast<int>(level));
    if (!field || field->centring != Centring::cell || component >= field->components()) {
      throw InputError(fmt::format(
          "{}: no cell variable '{}' with component {} of material {} on level {}; save it with "
          "<save label=\"{}\"/>",
          step.folder().string(), variable, component, material, level, variable));
    }
    for (const GridBox& box : grid.levels[level].boxes) {
      const DenseField values = step.read(*field, box.cells);
      for_each_cell(box.cells, [&](IntVec3 c) {
        if (covered(grid, level, c)) return;
        const exact::State state = reference.solution->at(grid.levels[level].centre(c), time);
        computed.push_back(values.at(c, component));
        exact.push_back(exact::exact_value(state, variable, component, reference.specific_heat));
        volumes.push_back(grid.levels[level].cell_volume());
      });
    }
  }
  if (grid.levels.size() == 1) volumes.clear();
  return exact::error_norms(computed, exact, volumes);
}

}  // namespace sluice
