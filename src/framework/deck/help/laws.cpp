// Laws as the schema describes them: each with its own list, or by tags that belong to words.
#include "framework/deck/help/laws.hpp"

#include <algorithm>
#include <set>

namespace sluice {
namespace {

void collect(const Schema& schema, const TagSpec& parent, const std::string& path,
             std::set<std::string>& groups, std::vector<TagPlace>& places) {
  const auto visit = [&](const TagSpec& spec) {
    const std::string own_path = path.empty() ? spec.name : path + '/' + spec.name;
    places.push_back({own_path, &spec});
    collect(schema, spec, own_path, groups, places);
  };
  for (const TagSpec& spec : parent.children) visit(spec);
  for (const std::string& group : parent.groups) {
    if (!groups.insert(group).second) continue;
    for (const TagSpec& spec : schema.groups.at(group)) visit(spec);
  }
}

bool listed_by_a_law(const TagSpec& parent, const std::string& name) {
  return std::any_of(parent.laws.begin(), parent.laws.end(), [&](const auto& law) {
    return std::any_of(law.second.begin(), law.second.end(),
                       [&](const TagSpec& tag) { return tag.name == name; });
  });
}

}  // namespace

bool read_by_all(const TagSpec& parent, const TagSpec& child) {
  return child.applies.first.empty() && !listed_by_a_law(parent, child.name);
}

std::vector<Law> laws_of(const Schema& schema, const TagSpec& spec) {
  std::vector<Law> laws;
  for (const auto& [word, tags] : spec.laws) {
    laws.push_back({spec.attributes.front().name, word, {}});
    for (const TagSpec& tag : tags) laws.back().tags.push_back(&tag);
  }
  for (const AttributeSpec& attribute : spec.attributes) {
    std::vector<Law> of_words;
    bool any = false;
    for (const std::string& word : attribute.value.words) {
      of_words.push_back({attribute.name, word, {}});
      for (const TagSpec* child : schema.children(spec)) {
        const auto& [name, words] = child->applies;
        if (name != attribute.name || std::find(words.begin(), words.end(), word) == words.end())
          continue;
        of_words.back().tags.push_back(child);
        any = true;
      }
    }
    if (any) laws.insert(laws.end(), of_words.begin(), of_words.end());
  }
  return laws;
}

std::vector<TagPlace> all_places(const Schema& schema) {
  std::vector<TagPlace> places;
  std::set<std::string> groups;
  collect(schema, schema.root, "", groups, places);
  return places;
}

}  // namespace sluice
