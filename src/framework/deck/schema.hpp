// What decks may contain: every tag described once, as data.
//
// From the one description come checking (schema_check.hpp), the defaults filled into the tree,
// `sluice help` and docs/deck_reference.md. A description is written fluently:
//
//   tag("cfl", "share of the stable time step").once().real().above(0).at_most(1)
//   tag("EOS", "equation of state").once().attribute(
//       attribute("type", "which one").once().words({"ideal_gas"}).not_built({"JWL", "TST"}))
//
// Components describe their own blocks; the app puts them together. A tag or word that the format
// knows and no description covers is refused as "not built yet", other names as unknown.
#pragma once
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "framework/deck/deck.hpp"

namespace sluice {

enum class TagType {
  none,         // no text; children and attributes only
  text,         // anything
  word,         // one of a closed list
  boolean,      // true or false
  integer,      //
  real,         //
  vector,       // [1.0, 2.0, 3.0]
  int_vector,   // [1, 2, 3]
  reals,        // list of numbers
  integers,     // list of integers
  int_vectors,  // [[2,2,1],[4,4,1]]
  index_set     // "0, 2-4, -1"; empty: all
};
std::string to_string(TagType);  // "real number", "[i,j,k]", ...

enum class Need { optional, once, multiple, at_least_once };

// In the unit of the value.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_open = false;
  bool high_open = false;

  bool contains(double value) const;
  bool limited() const;
  std::string text() const;  // "greater than 0 and at most 1"
};

// A value, of a tag or of an attribute.
struct ValueSpec {
  TagType type = TagType::none;
  Range range;  // of every component
  std::vector<std::string> words;
  std::vector<std::string> words_not_built;                         // known to the format
  std::vector<std::pair<std::string, std::string>> word_spellings;  // other spelling, word
  std::optional<std::string> default_text;
  std::string unit;
  std::vector<std::string> file_endings;  // of the files that a text names; empty: it names none
};

// What tags and attributes have in common, with the fluent methods.
template <class Derived>
struct Described {
  std::string name;
  std::string doc;
  Need need = Need::optional;
  ValueSpec value;
  std::vector<std::string> aliases;  // other spellings of the name

  Derived once() const {
    return with([](auto& s) { s.need = Need::once; });
  }
  Derived multiple() const {
    return with([](auto& s) { s.need = Need::multiple; });
  }
  Derived at_least_once() const {
    return with([](auto& s) { s.need = Need::at_least_once; });
  }

  Derived text() const { return typed(TagType::text); }
  // The name of a file; of several, where something is added to the name.
  Derived file(std::vector<std::string> endings = {""}) const {
    return with([&](auto& s) {
      s.value.type = TagType::text;
      s.value.file_endings = std::move(endings);
    });
  }
  Derived boolean() const { return typed(TagType::boolean); }
  Derived integer() const { return typed(TagType::integer); }
  Derived real() const { return typed(TagType::real); }
  Derived vector() const { return typed(TagType::vector); }
  Derived int_vector() const { return typed(TagType::int_vector); }
  Derived reals() const { return typed(TagType::reals); }
  Derived integers() const { return typed(TagType::integers); }
  Derived int_vectors() const { return typed(TagType::int_vectors); }
  Derived index_set() const { return typed(TagType::index_set); }
  Derived words(std::vector<std::string> list) const {
    return with([&](auto& s) {
      s.value.type = TagType::word;
      s.value.words = std::move(list);
    });
  }
  // In addition to those that there are.
  Derived more_words(const std::vector<std::string>& list) const {
    return with(
        [&](auto& s) { s.value.words.insert(s.value.words.end(), list.begin(), list.end()); });
  }
  Derived not_built(std::vector<std::string> list) const {
    return with([&](auto& s) { s.value.words_not_built = std::move(list); });
  }
  Derived spelling(std::string other, std::string word) const {
    return with([&](auto& s) { s.value.word_spellings.emplace_back(other, word); });
  }

  Derived at_least(double low) const {
    return with([&](auto& s) { s.value.range.low = low; });
  }
  Derived at_most(double high) const {
    return with([&](auto& s) { s.value.range.high = high; });
  }
  Derived above(double low) const {
    return with([&](auto& s) {
      s.value.range.low = low;
      s.value.range.low_open = true;
    });
  }

  Derived by_default(std::string text_of_default) const {
    return with([&](auto& s) { s.value.default_text = std::move(text_of_default); });
  }
  Derived unit(std::string name_of_unit) const {
    return with([&](auto& s) { s.value.unit = std::move(name_of_unit); });
  }
  Derived alias(std::string other_name) const {
    return with([&](auto& s) { s.aliases.push_back(std::move(other_name)); });
  }

  bool called(std::string_view a_name) const;

 protected:
  template <class Change>
  Derived with(Change change) const {
    Derived changed = static_cast<const Derived&>(*this);
    change(changed);
    return changed;
  }
  Derived typed(TagType type) const {
    return with([&](auto& s) { s.value.type = type; });
  }
};

struct AttributeSpec : Described<AttributeSpec> {};

struct TagSpec : Described<TagSpec> {
  std::vector<AttributeSpec> attributes;
  std::vector<TagSpec> children;
  std::vector<std::string> groups;               // named sets of children kept by the Schema
  std::vector<std::vector<std::string>> one_of;  // exactly one of these children
  std::vector<std::vector<std::string>> at_most_one_of;
  std::pair<std::string, std::vector<std::string>> applies;  // parent's attribute, its values
  // Of each word of an attribute that chooses among laws: the tags that this law reads, each with
  // its own meaning, range and default. Checks of spelling go by the children, help by these.
  std::vector<std::pair<std::string, std::vector<TagSpec>>> laws;
  bool filled = false;  // an absent tag is added with the defaults of its children

  TagSpec attribute(AttributeSpec spec) const {
    return with([&](TagSpec& s) { s.attributes.push_back(std::move(spec)); });
  }
  TagSpec child(TagSpec spec) const {
    return with([&](TagSpec& s) { s.children.push_back(std::move(spec)); });
  }
  TagSpec with_attributes(const std::vector<AttributeSpec>& specs) const {
    return with(
        [&](TagSpec& s) { s.attributes.insert(s.attributes.end(), specs.begin(), specs.end()); });
  }
  TagSpec with_children(const std::vector<TagSpec>& specs) const {
    return with(
        [&](TagSpec& s) { s.children.insert(s.children.end(), specs.begin(), specs.end()); });
  }
  TagSpec group(std::string group_name) const {
    return with([&](TagSpec& s) { s.groups.push_back(std::move(group_name)); });
  }
  TagSpec exactly_one(std::vector<std::string> names) const {
    return with([&](TagSpec& s) { s.one_of.push_back(std::move(names)); });
  }
  TagSpec not_both(std::vector<std::string> names) const {
    return with([&](TagSpec& s) { s.at_most_one_of.push_back(std::move(names)); });
  }
  // The tag belongs only to parents whose attribute has one of these values.
  TagSpec only_for(std::string attribute_name, std::vector<std::string> values) const {
    return with([&](TagSpec& s) { s.applies = {std::move(attribute_name), std::move(values)}; });
  }
  TagSpec fill() const {
    return with([](TagSpec& s) { s.filled = true; });
  }
  // Null: it has none of this name.
  AttributeSpec* attribute_of(std::string_view attribute_name) {
    for (AttributeSpec& spec : attributes)
      if (spec.called(attribute_name)) return &spec;
    return nullptr;
  }
};

inline TagSpec tag(std::string name, std::string doc) {
  TagSpec spec;
  spec.name = std::move(name);
  spec.doc = std::move(doc);
  return spec;
}
inline AttributeSpec attribute(std::string name, std::string doc) {
  AttributeSpec spec;
  spec.name = std::move(name);
  spec.doc = std::move(doc);
  return spec;
}

// A rule over several tags: reads the tree, adds what it finds wrong. It runs on decks that may
// have other faults, so it must not take any tag for granted.
using DeckRule = std::function<void(const DeckNode& root, std::vector<Fault>& faults)>;

// A change made before checking: obsolete tags mapped or dropped, with a warning each.
using DeckRewrite = std::function<void(DeckNode& root, std::vector<Fault>& faults)>;

class Schema {
 public:
  TagSpec root = tag("Uintah_specification", "the deck");
  std::map<std::string, std::vector<TagSpec>> groups;
  std::vector<DeckRewrite> rewrites;
  // Changes made after the overrides: what a deck may write in short is written in full.
  std::vector<DeckRewrite> completions;
  std::vector<DeckRule> rules;

  // The description of a child, by name or alias; nullptr when there is none.
  const TagSpec* child(const TagSpec& parent, std::string_view name) const;
  // All children of a tag, those of its groups included.
  std::vector<const TagSpec*> children(const TagSpec& parent) const;
  std::vector<std::string> child_names(const TagSpec& parent) const;

  // The description at a slash-separated path below the root; nullptr when there is none.
  const TagSpec* at(std::string_view path) const;
  TagSpec* at(std::string_view path) {
    return const_cast<TagSpec*>(static_cast<const Schema*>(this)->at(path));
  }

  // Adds a top-level block, or children to one that is there already.
  void add(TagSpec block);
};

}  // namespace sluice
