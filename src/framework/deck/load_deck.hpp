// A deck ready for use: read, brought up to date, overridden, checked, defaults filled in.
//
//   const Deck deck = load_deck("shock.ups", {"Grid/Level/Box/resolution=[500,1,1]"}, schema);
//   for (const Fault& fault : deck.faults) print(to_string(fault));
//   if (!deck.good()) return 2;
//
// Overrides, one "PATH=VALUE" each:
//   Grid/Level/Box/resolution=[500,1,1]   sets the tag, makes it where the schema has it
//   Grid/Level[1]/Box[@label=left]/...    selects among tags of one name, by number or attribute
//   CFD/ICE/advection/@type=FirstOrder    sets an attribute
//   Solver=                               deletes the tag (or attribute)
//   resolution=[500,1,1]                  the end of a path, where it means one place
//   +DataArchiver=<save label="rho_CC"/>  adds tags to a tag (addition("DataArchiver=..."))
// Setting <resolution> removes the level's <spacing>, and the other way round; setting one of
// several tags that exclude each other removes the others.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "framework/deck/deck.hpp"
#include "framework/deck/schema.hpp"

namespace sluice {

// An override that adds tags: "PATH=XML".
inline std::string addition(const std::string& path_and_xml) {
  return '+' + path_and_xml;
}
inline bool is_addition(std::string_view override_text) {
  return !override_text.empty() && override_text.front() == '+';
}

Deck load_deck(const std::string& file, const std::vector<std::string>& overrides,
               const Schema& schema);
Deck load_deck_text(std::string_view xml, const std::string& shown_name,
                    const std::vector<std::string>& overrides, const Schema& schema);

// A node with all that is below it.
std::unique_ptr<DeckNode> copy_of(const DeckNode& node);

// The same of a deck that has been read, or put together, without being checked.
Deck check_deck(Deck deck, const std::vector<std::string>& overrides, const Schema& schema);

// Passes of load_deck after reading, in its order; each adds to the faults. Those of the schema
// (rewrites, completions, rules) come with it.
void drop_obsolete(DeckNode& root, std::vector<Fault>& faults);
void apply_override(DeckNode& root, const std::string& override_text, const Schema& schema,
                    std::vector<Fault>& faults);

}  // namespace sluice
