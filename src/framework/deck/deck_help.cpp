// Words for the schema. The Markdown page is committed; a test compares it with this output.
#include "framework/deck/deck_help.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "framework/base/error.hpp"
#include "framework/deck/format_tags.hpp"
#include "framework/deck/nearest_name.hpp"
#include "framework/deck/schema_check.hpp"

namespace sluice {
namespace {

struct Place {
  std::string path;
  const TagSpec* spec;
};

// All tags in order, a group's members once, below the first tag that has the group.
void collect(const Schema& schema, const TagSpec& parent, const std::string& path,
             std::set<std::string>& groups, std::vector<Place>& places) {
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

std::vector<Place> all_places(const Schema& schema) {
  std::vector<Place> places;
  std::set<std::string> groups;
  collect(schema, schema.root, "", groups, places);
  return places;
}

std::string need_text(Need need) {
  switch (need) {
    case Need::once:
      return "required";
    case Need::optional:
      return "optional";
    case Need::multiple:
      return "any number";
    case Need::at_least_once:
      return "at least one";
  }
  return "";
}

// "real number greater than 0 and at most 1" or "one of FirstOrder, SecondOrder".
std::string value_text(const ValueSpec& value) {
  if (value.type == TagType::none) return "";
  if (value.type == TagType::word) {
    std::vector<std::string> words = value.words;
    for (std::string& word : words) {
      if (word.empty()) word = "nothing";
    }
    return fmt::format("one of {}", fmt::join(words, ", "));
  }
  std::string text = to_string(value.type);
  if (value.range.limited()) text += ", " + value.range.text();
  return text;
}

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

std::string describe_tag(const Schema& schema, const Place& place) {
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
  const auto children = schema.children(spec);
  if (!children.empty()) text += "  contains:\n";
  for (const TagSpec* child : children) {
    text += fmt::format("    {:<28} {}\n", child->name, child->doc);
  }
  for (const auto& names : spec.one_of) {
    text += fmt::format("  exactly one of {}\n", fmt::join(names, ", "));
  }
  for (const auto& names : spec.at_most_one_of) {
    text += fmt::format("  at most one of {}\n", fmt::join(names, ", "));
  }
  return text;
}

std::string in_cell(std::string text) {
  std::string cell;
  for (const char c : text) {
    if (c == '|') cell += '\\';
    cell += c;
  }
  return cell;
}

template <class Spec>
std::string table_row(const Spec& spec, const std::string& name, const std::string& extra) {
  std::string doc = spec.doc + extra;
  if (!spec.aliases.empty()) doc += fmt::format("; also written {}", fmt::join(spec.aliases, ", "));
  if (const auto words = unsupported_words(spec.value); !words.empty())
    doc += fmt::format("; not supported yet: {}", fmt::join(words, ", "));
  return fmt::format("| {} | {} | {} | {} | {} | {} |\n", name, in_cell(value_text(spec.value)),
                     need_text(spec.need), spec.value.default_text.value_or(""), spec.value.unit,
                     in_cell(doc));
}

std::string section(const Place& place) {
  const TagSpec& spec = *place.spec;
  const auto depth = std::count(place.path.begin(), place.path.end(), '/');
  std::string text = fmt::format("\n{} {}\n\n", depth == 0 ? "##" : "###", place.path);
  text += fmt::format("{} ({}).\n", spec.doc, need_text(spec.need));
  for (const auto& names : spec.one_of) {
    text += fmt::format("Exactly one of {}.\n", fmt::join(names, ", "));
  }
  for (const auto& names : spec.at_most_one_of) {
    text += fmt::format("At most one of {}.\n", fmt::join(names, ", "));
  }
  for (const std::string& group : spec.groups) {
    if (group == "geometry_piece") text += "Any geometry pieces.\n";
  }
  if (spec.attributes.empty() && spec.children.empty()) return text;
  text +=
      "\n| tag or @attribute | value | need | default | unit | meaning |\n"
      "| --- | --- | --- | --- | --- | --- |\n";
  for (const AttributeSpec& attribute : spec.attributes) {
    text += table_row(attribute, '@' + attribute.name, "");
  }
  for (const TagSpec& child : spec.children) {
    std::string extra;
    if (!child.applies.first.empty()) {
      extra = fmt::format("; only where {} is {}", child.applies.first,
                          fmt::join(child.applies.second, " or "));
    }
    text += table_row(child, child.name, extra);
  }
  return text;
}

}  // namespace

std::string help_on(const Schema& schema, const std::string& name_or_path) {
  std::string wanted = name_or_path;
  while (!wanted.empty() && wanted.front() == '/') wanted.erase(wanted.begin());
  while (!wanted.empty() && wanted.back() == '/') wanted.pop_back();
  if (wanted.empty()) throw InputError("help on which tag? see sluice help");
  if (const TagSpec* spec = schema.at(wanted)) return describe_tag(schema, {wanted, spec});

  std::string text;
  std::vector<std::string> names;
  for (const Place& place : all_places(schema)) {
    names.push_back(place.spec->name);
    const bool ends = place.path.size() > wanted.size() &&
                      place.path.compare(place.path.size() - wanted.size() - 1, std::string::npos,
                                         '/' + wanted) == 0;
    if (!ends && !place.spec->called(wanted)) continue;
    text += (text.empty() ? "" : "\n") + describe_tag(schema, place);
  }
  if (!text.empty()) return text;
  const std::string last = wanted.substr(wanted.rfind('/') + 1);
  if (const auto parents = parents_in_format(last); !parents.empty()) {
    throw InputError(fmt::format("<{}> (in {}) is known to the format, but not supported yet", last,
                                 parents.front().empty() ? "the root" : parents.front()));
  }
  const auto nearest = nearest_name(last, names);
  throw InputError(fmt::format("there is no tag '{}'{}", name_or_path,
                               nearest ? fmt::format(" (did you mean '{}'?)", *nearest) : ""));
}

std::string help_overview(const Schema& schema) {
  std::string text = "Blocks of a deck (sluice help TAG or PATH for more):\n";
  for (const TagSpec& block : schema.root.children) {
    text += fmt::format("  {:<24} {}\n", block.name, block.doc);
  }
  return text;
}

std::string markdown_reference(const Schema& schema) {
  std::string text =
      "# Deck reference\n\nThis page lists every tag that Sluice reads, with its values and "
      "defaults. It is written by\n`sluice help --markdown`; `sluice help TAG` shows one tag, "
      "`sluice check DECK` finds all\nfaults of a deck. The root element is "
      "`<Uintah_specification>`. A deck may use any consistent set of\nunits; nothing is "
      "converted.\n\n`<include href=\"FILE\" section=\"A/B\"/>` is replaced by the tag `A/B` of "
      "another file; any further\nattribute of the include must be present on that tag. The file "
      "is searched for in the folder of the\nincluding file, then in the current folder.\n";
  std::vector<Place> pieces;
  for (const Place& place : all_places(schema)) {
    const bool leaf = place.spec->children.empty() && place.spec->attributes.empty();
    const bool top = place.path.find('/') == std::string::npos;
    if (leaf && !top) continue;
    const auto& members = schema.groups.at("geometry_piece");
    const bool of_piece = std::any_of(members.begin(), members.end(), [&](const TagSpec& piece) {
      return &piece == place.spec ||
             place.path.find("geom_object/" + piece.name + '/') != std::string::npos;
    });
    if (of_piece) {
      pieces.push_back(place);
    } else {
      text += section(place);
    }
  }
  text +=
      "\n## Geometry pieces\n\nGeometry pieces are regions of space in a `<geom_object>`, or in "
      "another piece for the operators. An empty\ntag with the label of another piece repeats that "
      "piece.\n";
  for (Place place : pieces) {
    const auto at = place.path.find("geom_object/");
    if (at != std::string::npos) place.path = "geom_object" + place.path.substr(at + 11);
    text += section(place);
  }
  return text;
}

}  // namespace sluice
