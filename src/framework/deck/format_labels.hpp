// Names of the variables that the deck format knows, whether or not anything here computes them.
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace sluice {

// Whether some component of the format has a variable of this name.
bool format_has_label(std::string_view label);

// One of the format that no scheme here has, and why.
struct ForeignLabel {
  std::string name;    // or how several names begin; after *: how they end
  std::string reason;  // a sentence's end
  std::string instead;
};
const ForeignLabel* find_foreign_label(std::string_view label);
// What a deck is told that names it.
std::string refusal_of(const ForeignLabel& foreign, std::string_view label);

}  // namespace sluice
