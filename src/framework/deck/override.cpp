// --set PATH=VALUE and --add PATH=XML: the deck changed from the command line.
#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "framework/deck/faults.hpp"
#include "framework/deck/load_deck.hpp"
#include "framework/deck/nearest_name.hpp"
#include "framework/deck/override_path.hpp"
#include "framework/deck/value_text.hpp"
#include "framework/deck/xml_reader.hpp"

namespace sluice {
namespace {

constexpr const char* usage_of_set =
    "write PATH=VALUE, as Grid/Level/Box/resolution=[500,1,1] or "
    "CFD/ICE/advection/@type=FirstOrder";
constexpr const char* usage_of_add =
    "write PATH=XML, as DataArchiver=<save label=\"vol_frac_CC\"/>";

// A path and what stands behind its '='.
std::pair<TagPath, std::string> path_and_rest(std::string_view text, const char* usage) {
  const auto equals = find_outside_brackets(text, '=');
  if (equals == std::string_view::npos) throw OverrideFault{"there is no '='", usage};
  return {parse_tag_path(text.substr(0, equals)), std::string(text.substr(equals + 1))};
}

// The tags that a text of XML writes, includes resolved. Throws OverrideFault where it is none.
std::vector<std::unique_ptr<DeckNode>> tags_in(const std::string& xml, const std::string& origin,
                                               std::vector<Fault>& faults) {
  ReadBudget budget;
  XmlTree tree = read_xml_text("<add>" + xml + "</add>", origin, budget);
  if (tree.root == nullptr || !tree.faults.empty()) {
    const std::string why = tree.faults.empty() ? "" : ": " + tree.faults.front().message;
    throw OverrideFault{"this is no XML" + why, usage_of_add};
  }
  if (tree.root->children.empty() || !tree.root->text.empty())
    throw OverrideFault{"there is no tag behind the '='", usage_of_add};
  resolve_includes(*tree.root, budget, faults);
  return std::move(tree.root->children);
}

class Editor {
 public:
  Editor(DeckNode& root, const Schema& schema, std::string origin)
      : root_(root), schema_(schema), origin_(std::move(origin)) {}

  // Sets the tag or the attribute; an empty value deletes it.
  void set(const TagPath& path, const std::string& value) {
    const auto steps = steps_from_root(path.steps, root_, schema_);
    DeckNode* node = &root_;
    const TagSpec* spec = &schema_.root;
    const bool deletes = value.empty();
    for (std::size_t s = 0; s < steps.size(); ++s) {
      const bool last = s + 1 == steps.size() && path.attribute.empty();
      const auto [child, name, child_spec] = below(*node, spec, steps[s]);
      if (child == nullptr && deletes) return;  // already absent
      if (last && deletes) {
        std::erase_if(node->children, [&](const auto& c) { return c.get() == child; });
        return;
      }
      if (last) remove_rivals(*node, spec, name);
      node = child == nullptr ? create(*node, name, steps[s]) : child;
      spec = child_spec;
    }
    if (path.attribute.empty()) {
      node->text = value;
      node->where = {origin_, 0, 0};
    } else {
      set_attribute(*node, spec, path.attribute, value);
    }
  }

  // Puts tags behind those that a tag contains; the tag is made where there is none.
  void add(const TagPath& path, std::vector<std::unique_ptr<DeckNode>> tags) {
    if (!path.attribute.empty()) throw OverrideFault{"an attribute contains no tag", usage_of_add};
    DeckNode* node = &root_;
    const TagSpec* spec = &schema_.root;
    for (const PathStep& step : steps_from_root(path.steps, root_, schema_)) {
      const auto [child, name, child_spec] = below(*node, spec, step);
      node = child == nullptr ? create(*node, name, step) : child;
      spec = child_spec;
    }
    for (auto& tag : tags) node->children.push_back(std::move(tag));
  }

 private:
  struct Below {
    DeckNode* child;  // nullptr: there is none yet
    std::string name;
    const TagSpec* spec;
  };
  Below below(DeckNode& parent, const TagSpec* spec, const PathStep& step) const {
    const TagSpec* child_spec = spec == nullptr ? nullptr : schema_.child(*spec, step.name);
    const std::string name = child_spec == nullptr ? step.name : child_spec->name;
    DeckNode* child = choose(parent, name, step);
    if (child == nullptr && child_spec == nullptr) refuse_name(parent, spec, step.name);
    return {child, name, child_spec};
  }

  // The child that a step means; nullptr when there is none.
  static DeckNode* choose(DeckNode& parent, const std::string& name, const PathStep& step) {
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

  DeckNode* create(DeckNode& parent, const std::string& name, const PathStep& step) const {
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

void apply_override(DeckNode& root, const std::string& text, const Schema& schema,
                    std::vector<Fault>& faults) {
  const bool adds = is_addition(text);
  const std::string origin =
      adds ? "--add " + text.substr(1, find_outside_brackets(text, '=') - 1) : "--set " + text;
  try {
    Editor editor(root, schema, origin);
    if (adds) {
      const auto [path, xml] = path_and_rest(std::string_view(text).substr(1), usage_of_add);
      editor.add(path, tags_in(xml, origin, faults));
    } else {
      const auto [path, value] = path_and_rest(text, usage_of_set);
      editor.set(path, collapse_blanks(value));
    }
  } catch (const OverrideFault& fault) {
    add_error(faults, {origin, 0, 0}, fault.message, fault.suggestion);
  }
}

}  // namespace sluice
