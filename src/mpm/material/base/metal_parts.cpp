// Parts chosen by an attribute.
#include "mpm/material/base/metal_parts.hpp"

#include <fmt/format.h>

#include "framework/deck/faults.hpp"
#include "framework/deck/schema_check.hpp"

namespace sluice::mpm {
namespace {

AttributeSpec type_of(const std::vector<Part>& parts,
                      const std::vector<std::string>& not_supported) {
  std::vector<std::string> types;
  for (const Part& part : parts) types.push_back(part.type);
  return attribute("type", "which one").once().words(types).not_built(not_supported);
}

}  // namespace

TagSpec submodel_tag(std::string name, std::string doc, const std::vector<Part>& parts,
                     const std::vector<std::string>& not_supported) {
  std::vector<std::pair<std::string, const Tags*>> tags;
  for (const Part& part : parts) tags.emplace_back(part.type, &part.tags);
  TagSpec whole = choice_tag(std::move(name), std::move(doc), tags);
  whole.attributes = {type_of(parts, not_supported)};
  return whole;
}

ChosenSubmodel choose_submodel(const Parameters& model, const std::string& name,
                               const std::vector<Part>& parts,
                               const std::vector<std::string>& not_supported) {
  const DeckNode* child = model.block(name);
  if (child == nullptr) return {};
  std::string type = child->attribute("type").value_or("");
  const ValueVerdict verdict = judge_value(type_of(parts, not_supported).value, type);
  if (verdict.problem.empty())
    for (std::size_t k = 0; k < parts.size(); ++k)
      if (parts[k].type == type) return {static_cast<int>(k), true};
  if (!error_at(model.faults(), child->where)) {
    add_error(model.faults(), child->where, fmt::format("<{} type>: {}", name, verdict.problem),
              verdict.suggestion);
    model.faults().back().not_built = verdict.not_built;
  }
  return {-1, true};
}

Parameters inside_submodel(const Parameters& model, const std::string& name, const Part& part) {
  return {*model.block(name), part.type, part.tags, model.context(), model.faults()};
}

}  // namespace sluice::mpm
