// Looking things up in a schema, and words for its parts.
#include "framework/deck/schema.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace sluice {

std::string to_string(TagType type) {
  switch (type) {
    case TagType::none:
      return "no text";
    case TagType::text:
      return "text";
    case TagType::word:
      return "word";
    case TagType::boolean:
      return "true or false";
    case TagType::integer:
      return "integer";
    case TagType::real:
      return "real number";
    case TagType::vector:
      return "vector [x, y, z]";
    case TagType::int_vector:
      return "integer vector [i, j, k]";
    case TagType::reals:
      return "list of real numbers";
    case TagType::integers:
      return "list of integers";
    case TagType::int_vectors:
      return "list of integer vectors [[i, j, k], ...]";
    case TagType::index_set:
      return "set of indices such as 0, 2-4";
  }
  return "value";
}

bool Range::contains(double value) const {
  const bool above_low = low_open ? value > low : value >= low;
  const bool below_high = high_open ? value < high : value <= high;
  return above_low && below_high;
}

bool Range::limited() const {
  return low > -std::numeric_limits<double>::infinity() ||
         high < std::numeric_limits<double>::infinity();
}

std::string Range::text() const {
  std::string text;
  if (low > -std::numeric_limits<double>::infinity()) {
    text += fmt::format("{} {}", low_open ? "greater than" : "at least", low);
  }
  if (high < std::numeric_limits<double>::infinity()) {
    text += fmt::format("{}{} {}", text.empty() ? "" : " and ", high_open ? "less than" : "at most",
                        high);
  }
  return text;
}

template <class Derived>
bool Described<Derived>::called(std::string_view a_name) const {
  return name == a_name || std::find(aliases.begin(), aliases.end(), a_name) != aliases.end();
}
template struct Described<TagSpec>;
template struct Described<AttributeSpec>;

std::vector<const TagSpec*> Schema::children(const TagSpec& parent) const {
  std::vector<const TagSpec*> all;
  for (const TagSpec& spec : parent.children) all.push_back(&spec);
  for (const std::string& group : parent.groups) {
    const auto members = groups.find(group);
    if (members == groups.end()) continue;
    for (const TagSpec& spec : members->second) all.push_back(&spec);
  }
  return all;
}

const TagSpec* Schema::child(const TagSpec& parent, std::string_view name) const {
  for (const TagSpec* spec : children(parent)) {
    if (spec->called(name)) return spec;
  }
  return nullptr;
}

std::vector<std::string> Schema::child_names(const TagSpec& parent) const {
  std::vector<std::string> names;
  for (const TagSpec* spec : children(parent)) names.push_back(spec->name);
  return names;
}

const TagSpec* Schema::at(std::string_view path) const {
  const TagSpec* spec = &root;
  while (spec != nullptr && !path.empty()) {
    const auto slash = path.find('/');
    spec = child(*spec, path.substr(0, slash));
    path = slash == std::string_view::npos ? std::string_view{} : path.substr(slash + 1);
  }
  return spec;
}

void Schema::add(TagSpec block) {
  for (TagSpec& present : root.children) {
    if (present.name != block.name) continue;
    for (TagSpec& child : block.children) present.children.push_back(std::move(child));
    for (AttributeSpec& spec : block.attributes) present.attributes.push_back(std::move(spec));
    return;
  }
  root.children.push_back(std::move(block));
}

}  // namespace sluice
