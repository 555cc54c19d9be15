// The table of the format's tags, parsed once.
#include "framework/deck/format_tags.hpp"

#include <algorithm>
#include <map>
#include <sstream>

namespace sluice {
namespace {

constexpr const char* format_tags =
#include "framework/deck/format_tags.inc"
    ;

using Table = std::map<std::string, std::vector<std::string>, std::less<>>;

Table parse_table() {
  Table table;
  std::vector<std::string>* children = nullptr;
  std::istringstream words(format_tags);
  for (std::string word; words >> word;) {
    if (word.back() == ':') {
      word.pop_back();
      children = &table[word == "/" ? std::string() : word];
    } else if (children != nullptr) {
      children->push_back(word);
    }
  }
  return table;
}

const Table& table() {
  static const Table parsed = parse_table();
  return parsed;
}

bool lists(std::string_view parent, std::string_view child) {
  const auto at = table().find(parent);
  return at != table().end() &&
         std::find(at->second.begin(), at->second.end(), child) != at->second.end();
}

}  // namespace

bool known_to_format(std::string_view parent_path, std::string_view child) {
  if (lists(parent_path, child)) return true;
  // "*/geom_object" and "*/polyhedron/bounds" hold for every path that ends so.
  std::string_view tail = parent_path;
  for (;;) {
    if (lists("*/" + std::string(tail), child)) return true;
    const auto slash = tail.find('/');
    if (slash == std::string_view::npos) return false;
    tail.remove_prefix(slash + 1);
  }
}

std::vector<std::string> parents_in_format(std::string_view name) {
  std::vector<std::string> parents;
  for (const auto& [parent, children] : table()) {
    if (std::find(children.begin(), children.end(), name) != children.end()) {
      parents.push_back(parent);
    }
  }
  return parents;
}

}  // namespace sluice
