// Tags and laws of the schema, told for the terminal.
#include "framework/deck/help/deck_help.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "framework/deck/help/spec_words.hpp"
#include "framework/deck/schema_check.hpp"

namespace sluice {
namespace {

template <class Spec>
void describe(std::string& text, const Spec& spec, const std::string& indent) {
  const auto line = [&](const char* what, const std::string& value) {
    if (!value.empty()) text += fmt::format("{}{:<13} {}\n", indent, what, value);
  };
  line("value", value_text(spec.value));
  line("unit", spec.value.unit);
  line("default", spec.value.default_text.value_or(""));
  line("not supported", fmt::format("{}", fmt::join(unsupported_words(spec.value), ", ")));
  line("also", fmt::format("{}", fmt::join(spec.aliases, ", ")));
}

std::string describe_children(const Schema& schema, const TagSpec& spec) {
  std::string text;
  for (const TagSpec* child : schema.children(spec)) {
    if (read_by_all(spec, *child)) text += fmt::format("    {:<28} {}\n", child->name, child->doc);
  }
  if (!text.empty()) text = "  contains:\n" + text;
  const std::vector<Law> laws = laws_of(schema, spec);
  for (std::size_t l = 0; l < laws.size(); ++l) {
    if (l == 0 || laws[l].attribute != laws[l - 1].attribute)
      text += fmt::format("  and what its {} reads (sluice help {} tells it):\n", laws[l].attribute,
                          laws[l].word);
    std::string names;
    for (const TagSpec* tag : laws[l].tags) names += (names.empty() ? "" : " ") + tag->name;
    text += fmt::format("    {:<28} {}\n", laws[l].word, names.empty() ? "-" : names);
  }
  return text;
}

std::string describe_tag(const Schema& schema, const TagPlace& place) {
  const TagSpec& spec = *place.spec;
  std::string text = fmt::format("{}\n  {} ({})\n", place.path, spec.doc, need_text(spec.need));
  if (!spec.applies.first.empty()) {
    text += fmt::format("  only where {} is {}\n", spec.applies.first,
                        fmt::join(spec.applies.second, " or "));
  }
  describe(text, spec, "  ");
  for (const AttributeSpec& attribute : spec.attributes) {
    text +=
        fmt::format("  @{}: {} ({})\n", attribute.name, attribute.doc, need_text(attribute.need));
    describe(text, attribute, "      ");
  }
  text += describe_children(schema, spec);
  for (const auto& names : spec.one_of) {
    text += fmt::format("  exactly one of {}\n", fmt::join(names, ", "));
  }
  for (const auto& names : spec.at_most_one_of) {
    text += fmt::format("  at most one of {}\n", fmt::join(names, ", "));
  }
  return text;
}

// "C        sensitivity to the rate of strain; real number, required".
std::string describe_constant(const TagSpec& tag) {
  std::string text = fmt::format("    {:<22} {}", tag.name, tag.doc);
  if (!tag.value.unit.empty() && tag.doc.find(tag.value.unit) == std::string::npos)
    text += ", " + tag.value.unit;
  const std::string value = value_text(tag.value);
  std::string need = need_text(tag.need);
  if (tag.value.default_text) need = "default " + *tag.value.default_text;
  return text + fmt::format(" ({}{})\n", value.empty() ? "" : value + "; ", need);
}

std::string indented(const std::string& text, const char* indent) {
  std::string out = indent;
  for (const char c : text) {
    out += c;
    if (c == '\n') out += indent;
  }
  while (!out.empty() && (out.back() == ' ' || out.back() == '\n')) out.pop_back();
  return out + '\n';
}

// The tags that the law reads, with those that all words of the tag read.
std::string describe_law(const Schema& schema, const TagPlace& place, const std::string& attribute,
                         const std::string& word, const std::string& example) {
  const TagSpec& spec = *place.spec;
  std::string text = fmt::format("<{} {}=\"{}\">, a {} of {}\n  {}\n", spec.name, attribute, word,
                                 attribute, place.path, spec.doc);
  std::string reads;
  for (const Law& law : laws_of(schema, spec)) {
    if (law.attribute != attribute || law.word != word) continue;
    for (const TagSpec* tag : law.tags) reads += describe_constant(*tag);
  }
  if (!reads.empty()) text += "  it reads:\n" + reads;
  std::string common;
  for (const TagSpec* child : schema.children(spec))
    if (read_by_all(spec, *child)) common += (common.empty() ? "" : ", ") + child->name;
  if (!common.empty()) text += "  as every " + attribute + " does: " + common + "\n";
  if (!example.empty()) text += "  example:\n" + indented(example, "    ");
  return text;
}

bool ends_with_path(const std::string& path, const std::string& wanted) {
  return path == wanted || path.ends_with('/' + wanted);
}

}  // namespace

std::string help_on_tag(const Schema& schema, const std::string& name_or_path) {
  std::string wanted = name_or_path;
  while (!wanted.empty() && wanted.front() == '/') wanted.erase(wanted.begin());
  while (!wanted.empty() && wanted.back() == '/') wanted.pop_back();
  if (wanted.empty()) return "";
  if (const TagSpec* spec = schema.at(wanted)) return describe_tag(schema, {wanted, spec});
  std::string text;
  for (const TagPlace& place : all_places(schema)) {
    if (!ends_with_path(place.path, wanted) && !place.spec->called(wanted)) continue;
    text += (text.empty() ? "" : "\n") + describe_tag(schema, place);
  }
  return text;
}

std::string help_on_law(const Schema& schema, const std::string& word, const LawExample& example) {
  std::string text;
  for (const TagPlace& place : all_places(schema))
    for (const AttributeSpec& attribute : place.spec->attributes) {
      const std::vector<std::string>& words = attribute.value.words;
      if (std::find(words.begin(), words.end(), word) == words.end()) continue;
      text += (text.empty() ? "" : "\n") +
              describe_law(schema, place, attribute.name, word,
                           example(place.spec->name, attribute.name, word));
    }
  return text;
}

std::vector<std::string> tag_names(const Schema& schema) {
  std::vector<std::string> names;
  for (const TagPlace& place : all_places(schema)) names.push_back(place.spec->name);
  return names;
}

std::vector<std::string> law_words(const Schema& schema) {
  std::vector<std::string> all;
  for (const TagPlace& place : all_places(schema))
    for (const AttributeSpec& attribute : place.spec->attributes)
      for (const std::string& word : attribute.value.words)
        if (!word.empty()) all.push_back(word);
  return all;
}

std::string help_overview(const Schema& schema) {
  std::string text = "Blocks of a deck (sluice help TAG or PATH for more):\n";
  for (const TagSpec& block : schema.root.children) {
    text += fmt::format("  {:<24} {}\n", block.name, block.doc);
  }
  return text;
}

}  // namespace sluice
