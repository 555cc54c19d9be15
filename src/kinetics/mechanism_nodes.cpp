#include "kinetics/mechanism_nodes.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "framework/base/error.hpp"
#include "framework/deck/value_text.hpp"

namespace sluice::kinetics {

void refuse(const DeckNode& node, const std::string& message) {
  throw InputError(fmt::format("{}: {}", to_string(node.where), message));
}

const DeckNode& needed(const DeckNode& node, const std::string& child) {
  const DeckNode* found = node.child(child);
  if (found == nullptr) refuse(node, fmt::format("<{}> has no <{}>", node.name, child));
  return *found;
}

std::string needed_attribute(const DeckNode& node, const std::string& name) {
  const auto found = node.attribute(name);
  if (!found) refuse(node, fmt::format("<{}> has no attribute '{}'", node.name, name));
  return *found;
}

double real(const DeckNode& node, const std::string& text) {
  const ParsedValue<double> parsed = parse_real(text);
  if (!parsed) refuse(node, fmt::format("<{}>: {}", node.name, parsed.problem));
  return *parsed.value;
}

double real(const DeckNode& node) {
  return real(node, node.text);
}

std::vector<double> reals(const DeckNode& node, const std::string& text) {
  const ParsedValue<std::vector<double>> parsed = parse_reals(text);
  if (!parsed) refuse(node, fmt::format("<{}>: {}", node.name, parsed.problem));
  return *parsed.value;
}

std::vector<std::string> words(const DeckNode& node) {
  const ParsedValue<std::vector<std::string>> parsed = parse_words(node.text);
  if (!parsed) refuse(node, fmt::format("<{}>: {}", node.name, parsed.problem));
  return *parsed.value;
}

std::vector<std::pair<std::string, std::string>> name_and_text(const DeckNode& node) {
  std::vector<std::pair<std::string, std::string>> all;
  if (node.text.empty()) return all;
  for (const std::string& word : words(node)) {
    const std::size_t colon = word.rfind(':');
    if (colon == std::string::npos || colon == 0)
      refuse(node,
             fmt::format("<{}>: {} is not of the form name:number", node.name, in_quotes(word)));
    all.emplace_back(word.substr(0, colon), word.substr(colon + 1));
  }
  return all;
}

std::vector<std::pair<std::string, int>> name_and_count(const DeckNode& node) {
  std::vector<std::pair<std::string, int>> all;
  for (const auto& [name, text] : name_and_text(node)) {
    const double count = real(node, text);
    if (!(count >= 1 && count <= 1000) || count != static_cast<int>(count))
      refuse(node, fmt::format("<{}>: {} of {}: whole numbers from 1 on are supported", node.name,
                               text, name));
    all.emplace_back(name, static_cast<int>(count));
  }
  return all;
}

void only_children(const DeckNode& node, const std::vector<std::string>& names) {
  for (const auto& child : node.children)
    if (std::find(names.begin(), names.end(), child->name) == names.end())
      refuse(*child, fmt::format("<{}> in <{}> is not supported (supported: {})", child->name,
                                 node.name, fmt::join(names, ", ")));
}

std::size_t place_of(const SpeciesIndices& places, const std::string& name, const DeckNode& node) {
  const auto found = places.find(name);
  if (found == places.end())
    refuse(node, fmt::format("<{}>: no species {} in the phase", node.name, in_quotes(name)));
  return found->second;
}

}  // namespace sluice::kinetics
