// The schema in words, for the terminal: tags, laws and the blocks of a deck.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "framework/deck/help/laws.hpp"
#include "framework/deck/schema.hpp"

namespace sluice {

// An element to paste for a word of a tag's attribute, as XML; empty where there is none.
using LawExample = std::function<std::string(const std::string& tag, const std::string& attribute,
                                             const std::string& word)>;

// Everything about a tag, named alone ("cfl") or by the end of its path ("ICE/advection"); all
// tags of that name where it stands in several places. Empty where there is none.
std::string help_on_tag(const Schema& schema, const std::string& name_or_path);

// A word that a deck may choose, "TST" or "johnson_cook": where it stands, what it reads, and an
// example. Empty where no attribute has the word.
std::string help_on_law(const Schema& schema, const std::string& word, const LawExample& example);

// Of all tags, and all words of laws.
std::vector<std::string> tag_names(const Schema& schema);
std::vector<std::string> law_words(const Schema& schema);

// The blocks and what stands directly in them.
std::string help_overview(const Schema& schema);

}  // namespace sluice
