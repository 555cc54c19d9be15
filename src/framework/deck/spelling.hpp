// Names in another spelling: with_color is withColor.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "framework/deck/deck.hpp"
#include "framework/deck/schema.hpp"

namespace sluice {

std::string without_capitals(std::string_view name);
// vonMises as von_mises.
std::string with_underscores(std::string_view name);
// In other capitals, or with underscores in their place.
bool is_spelling_of(std::string_view written, std::string_view name);
// Without capitals and underscores.
std::string plain_spelling(std::string_view name);

// Tags and attributes that differ from one name of the schema by these alone get that name, with a
// warning each; a tag that stands beside the name itself does not.
void settle_spelling(DeckNode& root, const Schema& schema, std::vector<Fault>& faults);

}  // namespace sluice
