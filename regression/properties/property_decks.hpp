// The decks over which properties are tested, each made small: a fraction of a second a run.
#pragma once
#include <ostream>
#include <string>
#include <vector>

namespace sluice::properties {

struct PropertyDeck {
  std::string name;  // of the test
  std::string file;  // empty: of a collection that is not here
  std::vector<std::string> overrides;

  bool here() const { return !file.empty(); }
  bool on_levels() const { return name.starts_with("amr_"); }
};
inline std::ostream& operator<<(std::ostream& out, const PropertyDeck& d) {
  return out << d.file;
}

// Our own decks, and those that must run unmodified of the collection that the variable
// SLUICE_DECKS names (the folder that holds inputs/).
const std::vector<PropertyDeck>& property_decks();

// One of each kind, on one level and on two: those of ./dev test. All others are left to
// ./dev verify properties.
std::vector<PropertyDeck> decks_of_kinds();
std::vector<PropertyDeck> other_decks();

// Whether a deck runs with <advection type="ThirdOrder"> too, as NAME_third_order.
bool bears_parabolas(const std::string& name);

// Steps of a run, and steps between its outputs and between its checkpoints; both are kept at the
// steps 1 + n interval.
inline constexpr int interval = 9, steps = 1 + 3 * interval;

}  // namespace sluice::properties
