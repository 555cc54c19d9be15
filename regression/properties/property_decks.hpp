// The decks over which properties are tested, each made small: a fraction of a second a run.
#pragma once
#include <string>
#include <vector>

namespace sluice::properties {

struct PropertyDeck {
  std::string name;  // of the test
  std::string file;
  std::vector<std::string> overrides;
};

// Our own decks and, where the variable SLUICE_DECKS names a collection that holds inputs/, those
// of the collection that must run unmodified.
const std::vector<PropertyDeck>& property_decks();

// Steps of a run, and steps between its outputs and between its checkpoints.
inline constexpr int steps = 27, interval = 9;

}  // namespace sluice::properties
