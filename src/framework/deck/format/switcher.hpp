// A run of several components in turn: what <SimulationComponent type="switcher"> holds.
//
// The deck of the run gives grid, output and the times of the run; each <subcomponent> names the
// deck of one component, with materials and limits of the time step of its own.
#pragma once
#include <string>
#include <vector>

#include "framework/deck/deck.hpp"

namespace sluice {

struct TagSpec;
class Schema;
struct ComponentWord;

// The word in <SimulationComponent type>.
inline constexpr const char* switcher_word = "switcher";

bool runs_switcher(const DeckNode& root);

// What may stand in <SimulationComponent> of such a run, where these components exist.
std::vector<TagSpec> switcher_tags(const std::vector<ComponentWord>& components);
void check_switcher(const DeckNode& root, std::vector<Fault>& faults);

// The file that <input_file> names: beside its deck, in the working directory, in the folders above
// the deck. Empty: there is none.
std::string find_subdeck(const DeckNode& input_file);

// The deck of one component, complete: with grid, output and times of the deck of the run.
struct SubDeck {
  Deck deck;
  Location where;  // of its <input_file>
  int after = 0;   // it takes over when so many steps of the run are done; the first: 0
};

// In turn, from a deck of a run without faults. What is wrong is in the faults of each.
std::vector<SubDeck> read_subdecks(const DeckNode& root, const Schema& schema);

}  // namespace sluice
