// The deck as a tree: every node knows its file, line and column; values are typed on request.
//
// A Deck is what remains after includes are resolved, overrides applied, obsolete tags mapped, and
// the schema has checked everything and filled in defaults. Code that reads it may therefore ask
// for any value that the schema describes; asking for one that it does not is a programming error
// and throws std::logic_error. Numbers have the units that the schema says, SI units in all.
#pragma once
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "framework/base/vec3.hpp"

namespace sluice {

struct Location {
  std::string file;
  int line = 0;
  int column = 0;  // 1-based; 0 when unknown
};
std::string to_string(const Location&);  // "deck.ups:12:7"

enum class Severity { error, warning, note };

// One thing wrong (or worth saying) about a deck.
struct Fault {
  Severity severity = Severity::error;
  Location where;
  std::string message;     // what was found and what was expected, one sentence
  std::string suggestion;  // nearest valid name or next thing to try; may be empty
  bool not_built = false;  // known to the deck format, not built yet (an error)
  bool absent = false;     // a required tag is not there
};
std::string to_string(const Fault&);  // "deck.ups:12:7: error: ... (did you mean 'cfl'?)"

class DeckNode {
 public:
  std::string name;
  std::string text;  // blanks collapsed, ends trimmed
  Location where;
  bool defaulted = false;  // filled in from the schema, not written in the deck
  std::vector<std::pair<std::string, std::string>> attributes;
  std::vector<std::unique_ptr<DeckNode>> children;

  // First child of this name, or nullptr.
  const DeckNode* child(std::string_view child_name) const;
  DeckNode* child(std::string_view child_name);
  // Child at a slash-separated path, or nullptr.
  const DeckNode* find(std::string_view path) const;
  std::vector<const DeckNode*> all(std::string_view child_name) const;
  std::optional<std::string> attribute(std::string_view attribute_name) const;
  // True when the child is written in the deck itself (not filled in as a default).
  bool has(std::string_view child_name) const;

  // This node's own text as a value.
  double as_real() const;
  int as_integer() const;
  bool as_boolean() const;
  Vec3 as_vector() const;
  IntVec3 as_int_vector() const;
  std::vector<double> as_reals() const;
  std::vector<IntVec3> as_int_vectors() const;  // [[2,2,1],[4,4,1]]

  // Value of a child (written or defaulted).
  double real(std::string_view child_name) const { return need(child_name).as_real(); }
  int integer(std::string_view child_name) const { return need(child_name).as_integer(); }
  bool boolean(std::string_view child_name) const { return need(child_name).as_boolean(); }
  Vec3 vector(std::string_view child_name) const { return need(child_name).as_vector(); }
  IntVec3 int_vector(std::string_view child_name) const { return need(child_name).as_int_vector(); }
  const std::string& string(std::string_view child_name) const { return need(child_name).text; }

  // The child, or std::logic_error naming this node and the child.
  const DeckNode& need(std::string_view child_name) const;
};

struct Deck {
  std::string file;                // as the user named it
  std::unique_ptr<DeckNode> root;  // <Uintah_specification>; nullptr when the XML cannot be read
  std::vector<Fault> faults;       // errors first found first; warnings among them

  bool good() const;  // no error among the faults
};

// A deck as written, includes resolved, nothing checked and no default filled in. Faults of the
// XML itself and of includes are in `faults`; the root is nullptr when nothing could be read.
Deck read_deck(const std::string& file);
Deck read_deck_text(std::string_view xml, const std::string& shown_name);

// Writes the resolved deck as XML (what an archive keeps as input.xml).
std::string to_xml(const DeckNode& root);
// One element with all that is below it.
std::string element_xml(const DeckNode& node);

}  // namespace sluice
