// Materials that models and analyses name, without regard to capitals where that is unambiguous.
#include <fmt/format.h>

#include <algorithm>

#include "framework/deck/faults.hpp"
#include "framework/deck/format/framework_schema.hpp"
#include "framework/deck/spelling.hpp"
#include "framework/deck/value_text.hpp"

namespace sluice {
namespace {

std::vector<std::string> names_of_materials(const DeckNode& root) {
  std::vector<std::string> names;
  for (const DeckNode* properties : root.all("MaterialProperties"))
    for (const auto& method : properties->children)
      for (const DeckNode* material : method->all("material"))
        names.push_back(material->attribute("name").value_or(""));
  return names;
}

void settle_names_below(DeckNode& node, const std::vector<std::string>& names,
                        std::vector<Fault>& faults) {
  constexpr const char* tags[] = {"material", "fromMaterial", "toMaterial"};
  for (const auto& child : node.children) settle_names_below(*child, names, faults);
  const bool names_one = std::find(std::begin(tags), std::end(tags), node.name) != std::end(tags);
  if (!names_one || node.text.empty() || !node.children.empty()) return;
  const auto same = [&](const std::string& name) {
    return without_capitals(name) == without_capitals(node.text);
  };
  if (std::find(names.begin(), names.end(), node.text) != names.end() ||
      std::count_if(names.begin(), names.end(), same) != 1)
    return;
  const std::string& meant = *std::find_if(names.begin(), names.end(), same);
  add_warning(faults, node.where,
              fmt::format("<{}>: {} is read as the material {}", node.name, in_quotes(node.text),
                          in_quotes(meant)));
  node.text = meant;
}

}  // namespace

void settle_material_names(DeckNode& root, std::vector<Fault>& faults) {
  const std::vector<std::string> names = names_of_materials(root);
  for (const auto& block : root.children)
    if (block->name == "Models" || block->name == "DataAnalysis")
      settle_names_below(*block, names, faults);
}

}  // namespace sluice
