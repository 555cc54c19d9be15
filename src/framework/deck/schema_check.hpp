// A tree against its schema: names, numbers of occurrences, values; then defaults, then rules.
#pragma once
#include <string>
#include <vector>

#include "framework/deck/deck.hpp"
#include "framework/deck/schema.hpp"

namespace sluice {

// What is wrong with a value; `problem` is empty for a good one. `text` is normalised: a word in
// another spelling is replaced by the word itself.
struct ValueVerdict {
  std::string problem;
  std::string suggestion;
  bool not_built = false;
  std::string read_as;  // the word that another spelling of it was read as
};
ValueVerdict judge_value(const ValueSpec& spec, std::string& text);

// The words that the format knows and that are not supported: a word of a table's row is supported,
// even where the list of the others still has it.
std::vector<std::string> unsupported_words(const ValueSpec& spec);

// Old spellings of tags and attributes become the names of the schema.
void normalise_names(DeckNode& root, const Schema& schema);

// Checks everything below the root and fills in defaults; adds to `faults`.
void check_structure(DeckNode& root, const Schema& schema, std::vector<Fault>& faults);

}  // namespace sluice
