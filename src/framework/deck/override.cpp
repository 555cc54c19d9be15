// --set PATH=VALUE: one value of the deck changed from the command line.
#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "framework/deck/faults.hpp"
#include "framework/deck/load_deck.hpp"
#include "framework/deck/nearest_name.hpp"
#include "framework/deck/schema_check.hpp"
#include "framework/deck/value_text.hpp"

namespace sluice {
namespace {

// One step of a path: NAME, NAME[2], NAME[@label=left].
struct Step {
  std::string name;
  int number = 0;  // 1-based; 0: not given
  std::string attribute, value;
};

struct Override {
  std::vector<Step> steps;
  std::string attribute;  // of the last step; empty: its text
  std::string value;      // empty: delete
};

// What is wrong with an override; caught in apply_override.
struct OverrideFault {
  std::string message, suggestion;
};

constexpr const char* usage =
    "write PATH=VALUE, as Grid/Level/Box/resolution=[500,1,1] or "
    "CFD/ICE/advection/@type=FirstOrder";

Step parse_step(std::string_view text) {
  Step step;
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

// The position of a character outside brackets.
std::size_t find_outside(std::string_view text, char wanted) {
  int depth = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '[') ++depth;
    if (text[i] == ']') --depth;
    if (text[i] == wanted && depth == 0) return i;
  }
  return std::string_view::npos;
}

Override parse_override(std::string_view text) {
  const auto equals = find_outside(text, '=');
  if (equals == std::string_view::npos) throw OverrideFault{"there is no '='", usage};
  Override parsed;
  parsed.value = collapse_blanks(text.substr(equals + 1));
  std::string_view path = text.substr(0, equals);
  while (!path.empty() && path.front() == '/') path.remove_prefix(1);
  while (!path.empty()) {
    const auto slash = find_outside(path, '/');
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

class Editor {
 public:
  Editor(DeckNode& root, const Schema& schema, std::string origin)
      : root_(root), schema_(schema), origin_(std::move(origin)) {}

  void apply(const Override& change) {
    DeckNode* node = &root_;
    const TagSpec* spec = &schema_.root;
    const bool deletes = change.value.empty();
    for (std::size_t s = 0; s < change.steps.size(); ++s) {
      const bool last = s + 1 == change.steps.size();
      const Step& step = change.steps[s];
      const TagSpec* child_spec = spec == nullptr ? nullptr : schema_.child(*spec, step.name);
      const std::string name = child_spec == nullptr ? step.name : child_spec->name;
      DeckNode* child = choose(*node, name, step);
      if (child == nullptr && child_spec == nullptr) refuse_name(*node, spec, step.name);
      if (child == nullptr && deletes) return;  // already absent
      if (last && deletes && change.attribute.empty()) {
        std::erase_if(node->children, [&](const auto& c) { return c.get() == child; });
        return;
      }
      if (last && change.attribute.empty()) remove_rivals(*node, spec, name);
      if (child == nullptr) child = create(*node, name, step);
      node = child;
      spec = child_spec;
    }
    if (change.attribute.empty()) {
      node->text = change.value;
      node->where = {origin_, 0, 0};
    } else {
      set_attribute(*node, spec, change.attribute, change.value);
    }
  }

 private:
  // The child that a step means; nullptr when there is none.
  static DeckNode* choose(DeckNode& parent, const std::string& name, const Step& step) {
    std::vector<DeckNode*> candidates;
    for (const auto& child : parent.children) {
      if (child->name != name) continue;
      if (!step.attribute.empty() && child->attribute(step.attribute) != step.value) continue;
      candidates.push_back(child.get());
    }
    if (step.number > 0) {
      if (step.number > static_cast<int>(candidates.size())) {
        throw OverrideFault{fmt::format("there is no <{}>[{}] in <{}>: it has {}", name,
                                        step.number, parent.name, candidates.size()),
                            ""};
      }
      return candidates[step.number - 1];
    }
    if (candidates.empty() && !step.attribute.empty()) {
      throw OverrideFault{fmt::format("no <{}> in <{}> has {}=\"{}\"", name, parent.name,
                                      step.attribute, step.value),
                          ""};
    }
    if (candidates.size() > 1) {
      throw OverrideFault{fmt::format("<{}> has {} <{}>", parent.name, candidates.size(), name),
                          fmt::format("choose one with {}[1] or {}[@NAME=VALUE]", name, name)};
    }
    return candidates.empty() ? nullptr : candidates.front();
  }

  [[noreturn]] void refuse_name(const DeckNode& parent, const TagSpec* spec,
                                const std::string& name) const {
    std::vector<std::string> names;
    if (spec != nullptr) names = schema_.child_names(*spec);
    for (const auto& child : parent.children) names.push_back(child->name);
    throw OverrideFault{fmt::format("<{}> has no <{}>", parent.name, name),
                        suggest_name(name, names)};
  }

  DeckNode* create(DeckNode& parent, const std::string& name, const Step& step) const {
    auto made = std::make_unique<DeckNode>();
    made->name = name;
    made->where = {origin_, 0, 0};
    if (!step.attribute.empty()) made->attributes.emplace_back(step.attribute, step.value);
    parent.children.push_back(std::move(made));
    return parent.children.back().get();
  }

  // Tags that exclude the one being set.
  void remove_rivals(DeckNode& parent, const TagSpec* spec, const std::string& name) {
    std::vector<std::string> rivals;
    if (spec != nullptr) {
      for (const auto* sets : {&spec->one_of, &spec->at_most_one_of}) {
        for (const auto& set : *sets) {
          if (std::find(set.begin(), set.end(), name) == set.end()) continue;
          rivals.insert(rivals.end(), set.begin(), set.end());
        }
      }
    }
    std::erase_if(parent.children, [&](const auto& child) {
      return child->name != name &&
             std::find(rivals.begin(), rivals.end(), child->name) != rivals.end();
    });
    if (parent.name == "Level" && name == "spacing") {
      for (const auto& box : parent.children) {
        std::erase_if(box->children, [](const auto& c) { return c->name == "resolution"; });
      }
    }
    if (parent.name == "Box" && name == "resolution") {
      DeckNode* grid = root_.child("Grid");
      if (grid == nullptr) return;
      for (const auto& level : grid->children) {
        const bool holds = std::any_of(level->children.begin(), level->children.end(),
                                       [&](const auto& c) { return c.get() == &parent; });
        if (holds) {
          std::erase_if(level->children, [](const auto& c) { return c->name == "spacing"; });
        }
      }
    }
  }

  void set_attribute(DeckNode& node, const TagSpec* spec, std::string name,
                     const std::string& value) const {
    const bool written = node.attribute(name).has_value();
    if (spec != nullptr && !written) {
      std::vector<std::string> names;
      bool known = false;
      for (const AttributeSpec& candidate : spec->attributes) {
        names.push_back(candidate.name);
        if (!candidate.called(name)) continue;
        known = true;
        name = candidate.name;
      }
      if (!known) {
        throw OverrideFault{fmt::format("<{}> has no attribute '{}'", node.name, name),
                            suggest_name(name, names)};
      }
    }
    std::erase_if(node.attributes, [&](const auto& entry) { return entry.first == name; });
    if (!value.empty()) node.attributes.emplace_back(name, value);
    node.where = {origin_, 0, 0};
  }

  DeckNode& root_;
  const Schema& schema_;
  std::string origin_;
};

}  // namespace

void apply_override(DeckNode& root, const std::string& override_text, const Schema& schema,
                    std::vector<Fault>& faults) {
  const std::string origin = "--set " + override_text;
  try {
    Editor(root, schema, origin).apply(parse_override(override_text));
  } catch (const OverrideFault& fault) {
    add_error(faults, {origin, 0, 0}, fault.message, fault.suggestion);
  }
}

}  // namespace sluice
