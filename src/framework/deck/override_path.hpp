// Paths of tags on the command line: Grid/Level[1]/Box[@label=left]/resolution, or their end alone.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "framework/deck/deck.hpp"
#include "framework/deck/schema.hpp"

namespace sluice {

// One step of a path: NAME, NAME[2], NAME[@label=left].
struct PathStep {
  std::string name;
  int number = 0;  // 1-based; 0: not given
  std::string attribute, value;
};

struct TagPath {
  std::vector<PathStep> steps;
  std::string attribute;  // of the last step; empty: its text
};

// What is wrong with a change of a deck; apply_override makes a fault of the deck from it.
struct OverrideFault {
  std::string message, suggestion;
};

// The position of a character outside brackets; npos where there is none.
std::size_t find_outside_brackets(std::string_view text, char wanted);

// Throws OverrideFault where the text is no path.
TagPath parse_tag_path(std::string_view text);

// The steps from the root. A path may begin at any tag: it then means the one place of the deck,
// or else of the schema, that ends with these steps. Throws OverrideFault where there are several
// such places, or none.
std::vector<PathStep> steps_from_root(const std::vector<PathStep>& steps, const DeckNode& root,
                                      const Schema& schema);

}  // namespace sluice
