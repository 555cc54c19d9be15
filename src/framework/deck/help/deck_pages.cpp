// Markdown for the schema. The pages are committed; a test compares them with this output.
#include "framework/deck/help/deck_pages.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "framework/deck/help/laws.hpp"
#include "framework/deck/help/spec_words.hpp"
#include "framework/deck/schema_check.hpp"

namespace sluice {
namespace {

constexpr const char* index_head = R"(# Deck reference

Every tag that Sluice reads, with its values and defaults: a page for each block, a table for each
law. These pages are written by `sluice help --markdown FOLDER`; `sluice help NAME` shows one tag,
law or label, `sluice check DECK` finds all faults of a deck. The root element is
`<Uintah_specification>`. A deck may use any consistent set of units; nothing is converted.

`<include href="FILE" section="A/B"/>` is replaced by the tag `A/B` of another file; any further
attribute of the include must be present on that tag. The file is searched for in the folder of the
including file, then in the current folder.
)";

constexpr const char* table_head =
    "\n| tag or @attribute | value | need | default | unit | meaning |\n"
    "| --- | --- | --- | --- | --- | --- |\n";

constexpr const char* pieces_text =
    "\nGeometry pieces are regions of space in a `<geom_object>`, or in another piece for the "
    "operators. An empty\ntag with the label of another piece repeats that piece.\n";

std::string in_cell(const std::string& text) {
  std::string cell;
  for (const char c : text) {
    if (c == '|') cell += '\\';
    cell += c;
  }
  return cell;
}

template <class Spec>
std::string table_row(const Spec& spec, const std::string& name) {
  std::string doc = spec.doc;
  if (!spec.aliases.empty()) doc += fmt::format("; also written {}", fmt::join(spec.aliases, ", "));
  if (const auto words = unsupported_words(spec.value); !words.empty())
    doc += fmt::format("; not supported yet: {}", fmt::join(words, ", "));
  return fmt::format("| {} | {} | {} | {} | {} | {} |\n", name, in_cell(value_text(spec.value)),
                     need_text(spec.need), spec.value.default_text.value_or(""), spec.value.unit,
                     in_cell(doc));
}

// As GitHub makes anchors of headings.
std::string anchor_of(const std::string& heading) {
  std::string anchor;
  for (const char c : heading) {
    if (std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-')
      anchor += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    else if (c == ' ')
      anchor += '-';
  }
  return anchor;
}

std::string tables_of_laws(const Schema& schema, const TagSpec& spec) {
  std::string text, without;
  for (const Law& law : laws_of(schema, spec)) {
    if (law.tags.empty()) {
      without += (without.empty() ? "" : ", ") + fmt::format("`{}`", law.word);
      continue;
    }
    text += fmt::format("\n#### {} {}=\"{}\"\n{}", spec.name, law.attribute, law.word, table_head);
    for (const TagSpec* tag : law.tags) text += table_row(*tag, tag->name);
  }
  if (!without.empty()) text += fmt::format("\nWithout tags of their own: {}.\n", without);
  return text;
}

std::string section(const Schema& schema, const TagPlace& place) {
  const TagSpec& spec = *place.spec;
  const bool top = place.path.find('/') == std::string::npos;
  std::string text = fmt::format("\n{} {}\n\n", top ? "##" : "###", place.path);
  text += fmt::format("{} ({}).\n", spec.doc, need_text(spec.need));
  for (const auto& names : spec.one_of) {
    text += fmt::format("Exactly one of {}.\n", fmt::join(names, ", "));
  }
  for (const auto& names : spec.at_most_one_of) {
    text += fmt::format("At most one of {}.\n", fmt::join(names, ", "));
  }
  for (const std::string& group : spec.groups) {
    if (group == "geometry_piece") text += "Any [geometry pieces](geometry_pieces.md).\n";
  }
  std::string rows;
  for (const AttributeSpec& attribute : spec.attributes)
    rows += table_row(attribute, '@' + attribute.name);
  for (const TagSpec& child : spec.children)
    if (read_by_all(spec, child)) rows += table_row(child, child.name);
  if (!rows.empty()) text += table_head + rows;
  return text + tables_of_laws(schema, spec);
}

// A page for a block; materials of fluids and of solids have their own.
std::string page_of(const std::string& path) {
  for (const std::string method : {"ICE", "MPM"})
    if ((path + '/').starts_with("MaterialProperties/" + method + '/'))
      return "MaterialProperties_" + method;
  return path.substr(0, path.find('/'));
}

bool is_piece(const Schema& schema, const TagPlace& place) {
  const auto& members = schema.groups.at("geometry_piece");
  return std::any_of(members.begin(), members.end(), [&](const TagSpec& piece) {
    return &piece == place.spec ||
           place.path.find("geom_object/" + piece.name + '/') != std::string::npos;
  });
}

class Pages {
 public:
  explicit Pages(const Schema& schema) : schema_(schema) {}

  void add(TagPlace place) {
    if (is_piece(schema_, place)) {
      pieces_.push_back(std::move(place));
    } else {
      add_to(page_of(place.path), place);
    }
  }

  // The index first.
  std::vector<ReferencePage> finished() {
    for (TagPlace place : pieces_) {
      const auto at = place.path.find("geom_object/");
      if (at != std::string::npos) place.path = "geom_object" + place.path.substr(at + 11);
      add_to("geometry_pieces", place);
    }
    std::vector<ReferencePage> all = {{"deck_reference.md", index_head}};
    for (Page& page : pages_) {
      all.front().text += fmt::format("\n## {}\n\n{}", page.title, page.index);
      all.push_back({"deck/" + page.name + ".md", std::move(page.text)});
    }
    return all;
  }

 private:
  struct Page {
    std::string name, title, text, index;
  };

  Page& page(const std::string& name, const std::string& first_path) {
    for (Page& known : pages_)
      if (known.name == name) return known;
    const bool pieces = name == "geometry_pieces";
    const std::string title = pieces ? "Geometry pieces" : "Block " + first_path;
    pages_.push_back({name, title,
                      fmt::format("# {}\n\n[All blocks](../deck_reference.md)\n{}", title,
                                  pieces ? pieces_text : ""),
                      ""});
    return pages_.back();
  }

  void add_to(const std::string& name, const TagPlace& place) {
    Page& to = page(name, place.path);
    to.text += section(schema_, place);
    const std::string anchor = anchor_of(place.path);
    to.index += fmt::format("- <a id=\"{0}\"></a>[{1}](deck/{2}.md#{0}): {3}\n", anchor, place.path,
                            name, place.spec->doc);
  }

  const Schema& schema_;
  std::vector<TagPlace> pieces_;
  std::vector<Page> pages_;
};

}  // namespace

std::vector<ReferencePage> reference_pages(const Schema& schema) {
  Pages pages(schema);
  for (const TagPlace& place : all_places(schema)) {
    const bool leaf = place.spec->children.empty() && place.spec->attributes.empty();
    const bool top = place.path.find('/') == std::string::npos;
    if (!leaf || top) pages.add(place);
  }
  return pages.finished();
}

}  // namespace sluice
