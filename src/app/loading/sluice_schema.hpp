// The schema of every deck that Sluice reads: the framework's tags and those of each component.
#pragma once
#include <string>
#include <vector>

#include "framework/deck/deck.hpp"
#include "framework/deck/schema.hpp"

namespace sluice {

Schema sluice_schema();

// A deck by this schema. Throws InputError with all its errors, one a line.
Deck load_good_deck(const std::string& file, const std::vector<std::string>& overrides);

}  // namespace sluice
