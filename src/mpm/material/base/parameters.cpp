// Tags of a model held against their description.
#include "mpm/material/base/parameters.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <stdexcept>

#include "framework/base/text.hpp"
#include "framework/deck/faults.hpp"
#include "framework/deck/nearest_name.hpp"
#include "framework/deck/schema_check.hpp"
#include "framework/deck/value_text.hpp"

namespace sluice::mpm {

TagSpec positive(std::string name, std::string doc) {
  return tag(std::move(name), std::move(doc)).once().real().above(0);
}
TagSpec number(std::string name, std::string doc) {
  return tag(std::move(name), std::move(doc)).once().real();
}
TagSpec number(std::string name, std::string doc, double default_value) {
  return tag(std::move(name), std::move(doc)).real().by_default(fmt::format("{}", default_value));
}
TagSpec positive_or(std::string name, std::string doc, double default_value) {
  return number(std::move(name), std::move(doc), default_value).above(0);
}
TagSpec choice(std::string name, std::string doc, bool default_value) {
  return tag(std::move(name), std::move(doc))
      .boolean()
      .by_default(default_value ? "true" : "false");
}

TagSpec objective_tag() {
  return choice("objective",
                "whether stress rotates with the particle; false: the plain sum of rates, where "
                "rotation of a stressed body causes spurious stress",
                true);
}

bool error_at(const std::vector<Fault>& faults, const Location& where) {
  return std::any_of(faults.begin(), faults.end(), [&](const Fault& f) {
    return f.severity == Severity::error && f.where.file == where.file &&
           f.where.line == where.line && f.where.column == where.column;
  });
}

Parameters::Parameters(const DeckNode& node, std::string owner, const Tags& tags,
                       MaterialContext context, std::vector<Fault>& faults)
    : node_(&node), owner_(std::move(owner)), tags_(&tags), context_(context), faults_(&faults) {
  for (const auto& child : node.children) {
    const auto spec = std::find_if(tags.begin(), tags.end(),
                                   [&](const TagSpec& t) { return t.called(child->name); });
    if (spec != tags.end()) {
      check(*child, *spec);
    } else if (!child->defaulted) {
      std::vector<std::string> names;
      for (const TagSpec& t : tags) names.push_back(t.name);
      const auto nearest = nearest_name(child->name, names);
      add_warning(faults, child->where, fmt::format("{} never reads <{}>", owner_, child->name),
                  nearest ? fmt::format("did you mean '{}'?", *nearest) : "remove it");
    }
  }
  for (const TagSpec& t : tags)
    if (t.need == Need::once && node.child(t.name) == nullptr) {
      good_ = false;
      add_error(faults, node.where, fmt::format("{} needs <{}>: {}", owner_, t.name, t.doc));
    }
}

void Parameters::check(const DeckNode& child, const TagSpec& spec) {
  std::string value = child.text;
  const ValueVerdict verdict = judge_value(spec.value, value);
  if (verdict.problem.empty()) return;
  good_ = false;
  if (!error_at(*faults_, child.where))
    add_error(*faults_, child.where,
              fmt::format("{}: <{}>: {}", owner_, child.name, verdict.problem), verdict.suggestion);
}

const TagSpec& Parameters::described(std::string_view name) const {
  for (const TagSpec& t : *tags_)
    if (t.name == name) return t;
  throw std::logic_error(fmt::format("{} does not describe <{}>", owner_, name));
}

std::string Parameters::text(std::string_view name) const {
  const TagSpec& spec = described(name);
  if (const DeckNode* child = node_->child(name)) return child->text;
  if (!spec.value.default_text)
    throw std::logic_error(fmt::format("{}: <{}> is not given", owner_, name));
  return *spec.value.default_text;
}

double Parameters::real(std::string_view name) const {
  return parse_real(text(name)).value.value();
}
bool Parameters::flag(std::string_view name) const {
  return text(name) == "true";
}
std::string Parameters::word(std::string_view name) const {
  return text(name);
}
Vec3 Parameters::vector(std::string_view name) const {
  return parse_vector(text(name)).value.value();
}
std::vector<double> Parameters::reals(std::string_view name) const {
  return parse_reals(text(name)).value.value();
}

void Parameters::error(std::string_view name, std::string message, std::string suggestion) const {
  const DeckNode* child = node_->child(name);
  add_error(*faults_, child != nullptr ? child->where : node_->where,
            fmt::format("{}: {}", owner_, message), std::move(suggestion));
}

TagSpec choice_tag(std::string name, std::string doc,
                   const std::vector<std::pair<std::string, const Tags*>>& parts,
                   const std::vector<std::string>& never_read) {
  std::vector<std::string> types, order;
  std::map<std::string, TagSpec> tags;
  for (const auto& [type, of_part] : parts) {
    types.push_back(type);
    for (const TagSpec& t : *of_part) {
      std::string meaning = type + ": " + t.doc;
      if (t.value.range.limited()) meaning += " (" + t.value.range.text() + ")";
      if (t.value.default_text) meaning += ", default " + *t.value.default_text;
      const auto [at, fresh] = tags.try_emplace(t.name, t);
      if (fresh) {
        order.push_back(t.name);
        at->second.need = Need::optional;
        at->second.value.range = {};
        at->second.value.default_text.reset();
        at->second.doc = meaning;
      } else {
        at->second.doc += "; " + meaning;
      }
    }
  }
  TagSpec whole = tag(std::move(name), std::move(doc))
                      .attribute(attribute("type", "which one").once().words(types));
  for (const std::string& child : order) whole = whole.child(tags.at(child));
  for (const std::string& child : never_read)
    if (tags.count(child) == 0) whole = whole.child(tag(child, "accepted without effect").text());
  for (const auto& [type, of_part] : parts) whole.laws.emplace_back(type, *of_part);
  return whole;
}

}  // namespace sluice::mpm
