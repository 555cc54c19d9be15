// Reading paths, and finding the place that a short one means.
#include "framework/deck/override_path.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "framework/deck/nearest_name.hpp"
#include "framework/deck/value_text.hpp"

namespace sluice {
namespace {

constexpr const char* usage =
    "a path is written as Grid/Level[1]/Box[@label=left]/resolution or CFD/ICE/advection/@type";
constexpr std::size_t most_places_told = 6;

PathStep parse_step(std::string_view text) {
  PathStep step;
  const auto bracket = text.find('[');
  step.name = collapse_blanks(text.substr(0, bracket));
  if (step.name.empty()) throw OverrideFault{"a tag name is missing in the path", usage};
  if (bracket == std::string_view::npos) return step;
  if (text.back() != ']') throw OverrideFault{"a selector must end with ']'", usage};
  const auto inside = text.substr(bracket + 1, text.size() - bracket - 2);
  if (!inside.empty() && inside.front() == '@') {
    const auto equals = inside.find('=');
    if (equals == std::string_view::npos) {
      throw OverrideFault{fmt::format("selector [{}] has no '='", inside), usage};
    }
    step.attribute = std::string(inside.substr(1, equals - 1));
    step.value = std::string(inside.substr(equals + 1));
    return step;
  }
  const auto number = parse_integer(inside);
  if (!number || *number.value < 1) {
    throw OverrideFault{
        fmt::format("selector [{}] is neither a number from 1 on nor @NAME=VALUE", inside), usage};
  }
  step.number = *number.value;
  return step;
}

std::string text_of(const std::vector<PathStep>& steps) {
  std::string text;
  for (const PathStep& step : steps) {
    text += (text.empty() ? "" : "/") + step.name;
    if (step.number > 0) text += fmt::format("[{}]", step.number);
    if (!step.attribute.empty()) text += fmt::format("[@{}={}]", step.attribute, step.value);
  }
  return text;
}

// Gathers the places of tags that end with the given steps.
class PlacesOf {
 public:
  PlacesOf(const std::vector<PathStep>& steps, const Schema& schema)
      : steps_(steps), schema_(schema) {}

  // In a deck: the steps down to the parent of the first step given, with numbers where several
  // tags have one name.
  void find_in(const DeckNode& parent, const TagSpec* spec) {
    if (!above_.empty() && holds(parent, spec, 0)) found_.push_back(above_);
    for (const auto& child : parent.children) {
      int number = 0, of = 0;
      for (const auto& other : parent.children) {
        of += other->name == child->name ? 1 : 0;
        if (other == child) number = of;
      }
      above_.push_back({child->name, of > 1 ? number : 0, {}, {}});
      find_in(*child, spec == nullptr ? nullptr : schema_.child(*spec, child->name));
      above_.pop_back();
    }
  }

  // In the schema, where a deck has none; a group of tags is entered once.
  void find_in_schema(const TagSpec& parent) {
    if (!above_.empty() && described(parent)) found_.push_back(above_);
    const auto enter = [&](const TagSpec& spec) {
      names_.insert(spec.name);
      above_.push_back({spec.name, 0, {}, {}});
      find_in_schema(spec);
      above_.pop_back();
    };
    for (const TagSpec& spec : parent.children) enter(spec);
    for (const std::string& group : parent.groups) {
      if (!groups_.insert(group).second) continue;
      for (const TagSpec& spec : schema_.groups.at(group)) enter(spec);
    }
  }

  const std::vector<std::vector<PathStep>>& found() const { return found_; }
  std::vector<std::string> names() const { return {names_.begin(), names_.end()}; }

 private:
  bool meant(const DeckNode& node, const TagSpec* spec, const PathStep& step) const {
    const bool called = node.name == step.name || (spec != nullptr && spec->called(step.name));
    return called && (step.attribute.empty() || node.attribute(step.attribute) == step.value);
  }

  bool holds(const DeckNode& parent, const TagSpec* spec, std::size_t s) const {
    if (s == steps_.size()) return true;
    return std::any_of(parent.children.begin(), parent.children.end(), [&](const auto& child) {
      const TagSpec* below = spec == nullptr ? nullptr : schema_.child(*spec, child->name);
      return meant(*child, below, steps_[s]) && holds(*child, below, s + 1);
    });
  }

  bool described(const TagSpec& parent) const {
    const TagSpec* spec = &parent;
    for (const PathStep& step : steps_)
      if (spec != nullptr) spec = schema_.child(*spec, step.name);
    return spec != nullptr;
  }

  const std::vector<PathStep>& steps_;
  const Schema& schema_;
  std::vector<PathStep> above_;
  std::vector<std::vector<PathStep>> found_;
  std::set<std::string> groups_, names_;
};

std::vector<PathStep> joined(std::vector<PathStep> above, const std::vector<PathStep>& steps) {
  above.insert(above.end(), steps.begin(), steps.end());
  return above;
}

[[noreturn]] void refuse_several(const std::vector<std::vector<PathStep>>& places,
                                 const std::vector<PathStep>& steps, const char* where) {
  std::string list;
  for (std::size_t i = 0; i < std::min(places.size(), most_places_told); ++i)
    list += (i > 0 ? ", " : "") + text_of(joined(places[i], steps));
  if (places.size() > most_places_told)
    list += fmt::format(" and {} more", places.size() - most_places_told);
  throw OverrideFault{
      fmt::format("'{}' means {} places of {}", text_of(steps), places.size(), where),
      "write more of the path: " + list};
}

}  // namespace

std::size_t find_outside_brackets(std::string_view text, char wanted) {
  int depth = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '[') ++depth;
    if (text[i] == ']') --depth;
    if (text[i] == wanted && depth == 0) return i;
  }
  return std::string_view::npos;
}

TagPath parse_tag_path(std::string_view path) {
  TagPath parsed;
  while (!path.empty() && path.front() == '/') path.remove_prefix(1);
  while (!path.empty()) {
    const auto slash = find_outside_brackets(path, '/');
    const auto piece = path.substr(0, slash);
    path = slash == std::string_view::npos ? std::string_view{} : path.substr(slash + 1);
    if (!piece.empty() && piece.front() == '@') {
      parsed.attribute = collapse_blanks(piece.substr(1));
      if (!path.empty()) throw OverrideFault{"an attribute ends the path", usage};
    } else {
      parsed.steps.push_back(parse_step(piece));
    }
  }
  if (parsed.steps.empty()) throw OverrideFault{"the path is empty", usage};
  if (parsed.steps.front().name == "Uintah_specification") {
    parsed.steps.erase(parsed.steps.begin());
  }
  return parsed;
}

std::vector<PathStep> steps_from_root(const std::vector<PathStep>& steps, const DeckNode& root,
                                      const Schema& schema) {
  if (steps.empty()) return steps;
  const std::string& first = steps.front().name;
  if (root.child(first) != nullptr || schema.child(schema.root, first) != nullptr) return steps;
  PlacesOf in_deck(steps, schema);
  in_deck.find_in(root, &schema.root);
  if (in_deck.found().size() == 1) return joined(in_deck.found().front(), steps);
  if (in_deck.found().size() > 1) refuse_several(in_deck.found(), steps, "this deck");
  PlacesOf in_schema(steps, schema);
  in_schema.find_in_schema(schema.root);
  if (in_schema.found().size() == 1) return joined(in_schema.found().front(), steps);
  if (in_schema.found().size() > 1)
    refuse_several(in_schema.found(), steps, "the format, and the deck has none of them");
  const std::vector<std::string> names = in_schema.names();
  const auto unknown = std::find_if(steps.begin(), steps.end(), [&](const PathStep& step) {
    return std::find(names.begin(), names.end(), step.name) == names.end();
  });
  const std::string hint = unknown == steps.end() ? "" : suggest_name(unknown->name, names);
  throw OverrideFault{fmt::format("no deck has a tag '{}'", text_of(steps)), hint};
}

}  // namespace sluice
