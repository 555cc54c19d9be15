// From a deck of Peridigm to a deck of ours that says the same, with files of points.
//
// A converted deck has Peridigm's rules, each written in it: influence 1, no partial volumes, bonds
// between all blocks, bonds that break before the forces of a step, the fixed step, or that of the
// safety factor: dt = f min over i of sqrt(2 rho/sum V_j 18 K/(pi delta^4 r)).
// Every parameter that is not known is a fault with its line.
#pragma once
#include <map>
#include <string>
#include <vector>

#include "framework/deck/faults.hpp"
#include "peridynamics/peridigm/parameters.hpp"

namespace sluice::peridynamics {

struct ConvertedDeck {
  std::string name;                          // of the deck, without ending
  std::string ups;                           // its text
  std::map<std::string, std::string> files;  // of points: name, text
  std::vector<std::string> rules;            // what differs from the defaults of our decks
  std::vector<Fault> faults;
  bool good() const;
};

// `folder`: where the files that the deck names are.
ConvertedDeck convert_peridigm(const Parameter& deck, const std::string& name,
                               const std::string& folder);

}  // namespace sluice::peridynamics
