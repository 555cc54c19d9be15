// Materials that a model names.
#include "models/deck/material_name.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "framework/deck/nearest_name.hpp"
#include "framework/deck/value_text.hpp"
#include "framework/scene/deck_values.hpp"

namespace sluice::models {

// Some decks write names in quotes.
static std::string without_quotes(const std::string& name) {
  const bool quoted = name.size() > 2 && name.front() == '"' && name.back() == '"';
  return quoted ? name.substr(1, name.size() - 2) : name;
}

std::optional<int> find_material(const std::string& written,
                                 const std::vector<std::string>& materials) {
  const std::string name = without_quotes(written);
  const auto found = std::find(materials.begin(), materials.end(), name);
  if (found != materials.end() && !name.empty()) return static_cast<int>(found - materials.begin());
  const auto index = parse_integer(name);
  if (index && *index.value >= 0 && *index.value < static_cast<int>(materials.size()))
    return *index.value;
  return std::nullopt;
}

std::optional<int> check_material(const DeckNode& parent, const char* child,
                                  const std::vector<std::string>& materials,
                                  std::vector<Fault>& faults) {
  const DeckNode* node = parent.child(child);
  if (node == nullptr) return std::nullopt;  // told by the schema
  const std::optional<int> index = find_material(node->text, materials);
  if (index || materials.empty()) return index;
  add_error(faults, node->where,
            fmt::format("<{}>: there is no material {}", child, in_quotes(node->text)),
            suggest_name(node->text, materials));
  return std::nullopt;
}

int read_material(const DeckNode& parent, const char* child,
                  const std::vector<std::string>& materials) {
  const DeckNode* node = parent.child(child);
  return node == nullptr ? 0 : find_material(node->text, materials).value_or(0);
}

}  // namespace sluice::models
