// The table of equations of state. Formulas and references stand in the files of src/eos.
#include "ice/deck/fluid_laws.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "framework/deck/schema.hpp"

namespace sluice::ice {
namespace {

Range range_of(eos::Bound bound) {
  Range range;
  range.low = bound.low;
  range.low_open = bound.open;
  return range;
}

// What a law reads: "density of reference", kg/m^3, 1027 where it is absent.
template <class Law, class Owner>
TagSpec tag_of(const eos::Parameter<Owner>& number, const Law& start) {
  TagSpec spec = tag(std::string(number.name), std::string(number.meaning))
                     .real()
                     .unit(std::string(number.unit));
  spec.value.range = range_of(number.bound);
  if (number.given != eos::Given::in_law_or_default) return spec.once();
  return spec.by_default(fmt::format("{:g}", start.*number.member));
}

// "density of reference, kg/m^3; absent: 1027".
std::string meaning_of(const TagSpec& spec) {
  std::string text = spec.doc;
  if (!spec.value.unit.empty()) text += fmt::format(", {}", spec.value.unit);
  if (spec.value.default_text) text += "; absent: " + *spec.value.default_text;
  return text;
}

template <class Law>
LawEntry entry_of() {
  const Law start{};
  LawEntry entry{std::string(Law::name), start, {}, {}, false};
  for (const auto& number : Law::parameters()) {
    if (number.given == eos::Given::by_material) {
      entry.gamma_above_one |= number.name == "gamma";
      continue;
    }
    const TagSpec spec = tag_of(number, start);
    entry.reads.push_back(spec);
    entry.tags.push_back({spec.name, meaning_of(spec), spec.value.range,
                          spec.value.default_text.has_value(),
                          [member = number.member](eos::EquationOfState& law, double x) {
                            std::get<Law>(law).*member = x;
                          }});
  }
  return entry;
}

std::vector<LawEntry> make_table() {
  std::vector<LawEntry> table;
  eos::AllLaws::for_each([&]<class Law>() {
    if constexpr (eos::is_named_by_decks<Law>()) table.push_back(entry_of<Law>());
  });
  return table;
}

}  // namespace

const std::vector<LawEntry>& law_table() {
  static const std::vector<LawEntry> table = make_table();
  return table;
}

const LawEntry* find_law(std::string_view type) {
  for (const LawEntry& law : law_table())
    if (law.type == type) return &law;
  return nullptr;
}

bool has_tag(const LawEntry& law, std::string_view name) {
  return std::any_of(law.tags.begin(), law.tags.end(),
                     [&](const LawTag& tag) { return tag.name == name; });
}

bool tag_of_any_law(std::string_view name) {
  return std::any_of(law_table().begin(), law_table().end(),
                     [&](const LawEntry& law) { return has_tag(law, name); });
}

std::string laws_with_gamma() {
  std::vector<std::string> names;
  for (const LawEntry& law : law_table())
    if (law.gamma_above_one) names.push_back(law.type);
  const std::string last = names.back();
  names.pop_back();
  return fmt::format("{} and {}", fmt::join(names, ", "), last);
}

TagSpec equation_of_state_tag() {
  std::vector<std::string> types;
  std::vector<std::string> order;               // tags as they come
  std::map<std::string, std::string> meanings;  // of all laws
  for (const LawEntry& law : law_table()) {
    types.push_back(law.type);
    for (const LawTag& tag : law.tags) {
      std::string& meaning = meanings[tag.name];
      if (meaning.empty()) order.push_back(tag.name);
      meaning += (meaning.empty() ? "" : "; ") + law.type + ": " + tag.meaning;
      if (tag.range.limited()) meaning += " (" + tag.range.text() + ")";
    }
  }
  TagSpec eos =
      tag("EOS", "equation of state; docs/theory_eos.md has the formulas")
          .once()
          .attribute(attribute("type", "which one").once().words(types).not_built({"KumariDass"}))
          .child(tag("gas_constant", "accepted without effect").real());
  for (const std::string& name : order) eos = eos.child(tag(name, meanings.at(name)).real());
  for (const LawEntry& law : law_table()) eos.laws.emplace_back(law.type, law.reads);
  return eos;
}

}  // namespace sluice::ice
