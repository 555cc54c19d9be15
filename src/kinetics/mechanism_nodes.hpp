// Values of the XML of a mechanism, in the units of the file, read strictly; what is wrong throws
// InputError with its place.
#pragma once
#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "framework/deck/deck.hpp"

namespace sluice::kinetics {

[[noreturn]] void refuse(const DeckNode& node, const std::string& message);
const DeckNode& needed(const DeckNode& node, const std::string& child);
std::string needed_attribute(const DeckNode& node, const std::string& name);
double real(const DeckNode& node, const std::string& text);
double real(const DeckNode& node);
std::vector<double> reals(const DeckNode& node, const std::string& text);
// "H:1 O2:2" as names and their text.
std::vector<std::pair<std::string, std::string>> name_and_text(const DeckNode& node);
// The same with whole numbers from 1 on.
std::vector<std::pair<std::string, int>> name_and_count(const DeckNode& node);
std::vector<std::string> words(const DeckNode& node);
// Refuses a child of another name than these.
void only_children(const DeckNode& node, const std::vector<std::string>& names);

// Places of species by their names.
using SpeciesIndices = std::map<std::string, std::size_t>;
std::size_t place_of(const SpeciesIndices& places, const std::string& name, const DeckNode& node);

}  // namespace sluice::kinetics
