// A tree against its schema, in one pass that finds everything.
#include "framework/deck/schema_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "framework/deck/faults.hpp"
#include "framework/deck/format_tags.hpp"
#include "framework/deck/nearest_name.hpp"
#include "framework/deck/value_text.hpp"

namespace sluice {
namespace {

const AttributeSpec* attribute_spec(const TagSpec& spec, std::string_view name) {
  for (const AttributeSpec& candidate : spec.attributes) {
    if (candidate.called(name)) return &candidate;
  }
  return nullptr;
}

bool applies(const TagSpec& spec, const DeckNode& parent) {
  if (spec.applies.first.empty()) return true;
  const auto value = parent.attribute(spec.applies.first);
  const auto& valid = spec.applies.second;
  return value && std::find(valid.begin(), valid.end(), *value) != valid.end();
}

std::string join_path(const std::string& path, const std::string& name) {
  return path.empty() ? name : path + '/' + name;
}

class Checker {
 public:
  Checker(const Schema& schema, std::vector<Fault>& faults) : schema_(schema), faults_(faults) {}

  void check(DeckNode& node, const TagSpec& spec, const std::string& path) {
    // A word that is not built (another component, another equation of state) changes what may
    // stand inside, so nothing below it can be judged.
    const std::size_t before = faults_.size();
    if (!check_attributes(node, spec)) return;
    // A misspelt word leaves open which of the dependent tags belong here.
    const bool clear = faults_.size() == before;
    check_text(node, spec);
    const std::set<std::string> misspelt = misspelt_children(node, spec);
    check_children(node, spec, path, clear, misspelt);
    check_choices(node, spec, misspelt);
    fill_in(node, spec, path);
  }

 private:
  void fault(const DeckNode& node, std::string message, std::string suggestion = {}) {
    add_error(faults_, node.where, std::move(message), std::move(suggestion));
  }

  void tell_spelling(const DeckNode& node, const std::string& what, const std::string& written,
                     const ValueVerdict& verdict) {
    if (verdict.read_as.empty()) return;
    add_warning(faults_, node.where,
                fmt::format("{}: {} is an old spelling; read as {}", what, in_quotes(written),
                            in_quotes(verdict.read_as)));
  }

  // False when an attribute has a value that is not built yet.
  bool check_attributes(DeckNode& node, const TagSpec& spec) {
    bool built = true;
    for (auto& [name, value] : node.attributes) {
      const AttributeSpec* known = attribute_spec(spec, name);
      if (known == nullptr) {
        std::vector<std::string> names;
        for (const AttributeSpec& candidate : spec.attributes) names.push_back(candidate.name);
        fault(node, fmt::format("<{}> has no attribute {}", node.name, in_quotes(name)),
              suggest_name(name, names));
        continue;
      }
      value = collapse_blanks(value);
      const std::string written = value;
      const ValueVerdict verdict = judge_value(known->value, value);
      tell_spelling(node, fmt::format("<{} {}>", node.name, name), written, verdict);
      if (verdict.problem.empty()) continue;
      fault(node, fmt::format("<{} {}>: {}", node.name, name, verdict.problem), verdict.suggestion);
      faults_.back().not_built = verdict.not_built;
      built = built && !verdict.not_built;
    }
    if (built) add_missing_attributes(node, spec);
    return built;
  }

  void add_missing_attributes(DeckNode& node, const TagSpec& spec) {
    for (const AttributeSpec& known : spec.attributes) {
      if (node.attribute(known.name)) continue;
      if (known.value.default_text) {
        node.attributes.emplace_back(known.name, *known.value.default_text);
      } else if (known.need == Need::once) {
        std::string valid;
        if (!known.value.words.empty()) {
          valid = fmt::format("valid: {}", fmt::join(known.value.words, ", "));
        }
        fault(node, fmt::format("<{}> needs the attribute {}=\"...\"", node.name, known.name),
              valid);
      }
    }
  }

  void check_text(DeckNode& node, const TagSpec& spec) {
    const std::string written = node.text;
    const ValueVerdict verdict = judge_value(spec.value, node.text);
    tell_spelling(node, fmt::format("<{}>", node.name), written, verdict);
    if (verdict.problem.empty()) return;
    fault(node, fmt::format("<{}>: {}", node.name, verdict.problem), verdict.suggestion);
    faults_.back().not_built = verdict.not_built;
  }

  // Names that unknown children most likely mean: what is told there is not told to be missing.
  std::set<std::string> misspelt_children(const DeckNode& node, const TagSpec& spec) const {
    std::set<std::string> meant;
    for (const auto& child : node.children) {
      if (schema_.child(spec, child->name) != nullptr) continue;
      if (const auto nearest = nearest_name(child->name, schema_.child_names(spec)))
        meant.insert(*nearest);
    }
    return meant;
  }

  void check_children(DeckNode& node, const TagSpec& spec, const std::string& path, bool clear,
                      const std::set<std::string>& misspelt) {
    std::map<std::string, const DeckNode*> seen;
    for (const auto& child : node.children) {
      const TagSpec* known = schema_.child(spec, child->name);
      if (known == nullptr) {
        refuse(*child, spec, path);
        continue;
      }
      if (!applies(*known, node)) {
        if (!clear) continue;
        fault(*child, fmt::format("<{}> belongs to <{}> with {}={} only", child->name, node.name,
                                  known->applies.first, fmt::join(known->applies.second, " or ")));
        continue;
      }
      const auto [first, fresh] = seen.try_emplace(known->name, child.get());
      const bool single = known->need == Need::once || known->need == Need::optional;
      if (!fresh && single) {
        fault(*child,
              fmt::format("second <{}> in <{}>; the first is at {}", child->name, node.name,
                          to_string(first->second->where)),
              "remove one of them");
      }
      check(*child, *known, join_path(path, known->name));
    }
    for (const TagSpec* known : schema_.children(spec)) {
      const bool needed = known->need == Need::once || known->need == Need::at_least_once;
      if (!needed || !applies(*known, node) || seen.count(known->name) > 0) continue;
      if (misspelt.count(known->name) > 0) continue;
      fault(node, fmt::format("<{}> needs <{}>: {}", node.name, known->name, known->doc));
      faults_.back().absent = true;
    }
  }

  // A child without description: not built yet, or unknown.
  void refuse(const DeckNode& child, const TagSpec& parent, const std::string& path) {
    if (known_to_format(path, child.name)) {
      add_not_built(faults_, child.where, fmt::format("<{}>", child.name));
      return;
    }
    std::vector<std::string> names;
    for (const TagSpec* spec : schema_.children(parent)) {
      names.push_back(spec->name);
      names.insert(names.end(), spec->aliases.begin(), spec->aliases.end());
    }
    std::string suggestion;
    if (const auto nearest = nearest_name(child.name, names)) {
      suggestion = fmt::format("did you mean '{}'?", *nearest);
    } else if (const std::string home = home_of(child.name); !home.empty()) {
      suggestion = fmt::format("it belongs to {}", home);
    } else {
      suggestion = suggest_name(child.name, names);
    }
    fault(child, fmt::format("<{}> does not exist in <{}>", child.name, parent.name), suggestion);
  }

  // The block that has a tag of this name in the format, one that is built if possible.
  std::string home_of(const std::string& name) const {
    const auto parents = parents_in_format(name);
    const auto built = std::find_if(parents.begin(), parents.end(), [&](const std::string& path) {
      return !path.empty() && schema_.at(path) != nullptr;
    });
    if (built != parents.end()) return *built;
    if (parents.empty()) return {};
    return parents.front().empty() ? "the root" : parents.front();
  }

  void check_choices(const DeckNode& node, const TagSpec& spec,
                     const std::set<std::string>& misspelt) {
    for (const auto& names : spec.one_of) {
      const auto present = present_of(node, names);
      const bool told = std::any_of(names.begin(), names.end(), [&](const std::string& name) {
        return misspelt.count(name) > 0;
      });
      if (present.empty() && !told) {
        fault(node, fmt::format("<{}> needs one of <{}>", node.name, fmt::join(names, ">, <")));
      } else if (present.size() > 1) {
        fault(*present[1],
              fmt::format("<{}> and <{}> exclude each other", present[0]->name, present[1]->name),
              "remove one of them");
      }
    }
    for (const auto& names : spec.at_most_one_of) {
      const auto present = present_of(node, names);
      if (present.size() < 2) continue;
      fault(*present[1],
            fmt::format("<{}> and <{}> exclude each other", present[0]->name, present[1]->name),
            "remove one of them");
    }
  }

  static std::vector<const DeckNode*> present_of(const DeckNode& node,
                                                 const std::vector<std::string>& names) {
    std::vector<const DeckNode*> present;
    for (const std::string& name : names) {
      if (const DeckNode* child = node.child(name)) present.push_back(child);
    }
    return present;
  }

  void fill_in(DeckNode& node, const TagSpec& spec, const std::string& path) {
    for (const TagSpec* known : schema_.children(spec)) {
      const bool single = known->need == Need::optional;
      if (!single || !applies(*known, node) || node.child(known->name) != nullptr) continue;
      if (!known->value.default_text && !known->filled) continue;
      auto added = std::make_unique<DeckNode>();
      added->name = known->name;
      added->where = node.where;
      added->defaulted = true;
      added->text = known->value.default_text.value_or("");
      DeckNode& raw = *added;
      node.children.push_back(std::move(added));
      check(raw, *known, join_path(path, known->name));
    }
  }

  const Schema& schema_;
  std::vector<Fault>& faults_;
};

void normalise(DeckNode& node, const TagSpec& spec, const Schema& schema) {
  for (auto& [name, value] : node.attributes) {
    if (const AttributeSpec* known = attribute_spec(spec, name)) name = known->name;
  }
  for (const auto& child : node.children) {
    const TagSpec* known = schema.child(spec, child->name);
    if (known == nullptr) continue;
    child->name = known->name;
    normalise(*child, *known, schema);
  }
}

}  // namespace

void normalise_names(DeckNode& root, const Schema& schema) {
  normalise(root, schema.root, schema);
}

void check_structure(DeckNode& root, const Schema& schema, std::vector<Fault>& faults) {
  Checker(schema, faults).check(root, schema.root, "");
}

}  // namespace sluice
