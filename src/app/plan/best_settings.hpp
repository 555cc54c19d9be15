// The basis, form and particles of solids that the accuracy studies prove to be best, for a deck.
//
// No deck changes its basis in silence: `sluice plan` names these settings, `sluice run
// --best-settings` takes them. The figures are those of the study axis_aligned (docs/accuracy.md);
// a test compares the errors with its table.
#pragma once
#include <string>
#include <vector>

#include "framework/deck/deck.hpp"

namespace sluice {

struct BestSettings {
  // PATH=VALUE; empty: the deck has the best ones, or none is known for it.
  std::vector<std::string> overrides;
  // One sentence for each solid, or for the deck.
  std::vector<std::string> reasons;
};

// Of the file `deck` with these overrides (PATH=VALUE). Settings that the deck refuses, with what
// else it has, are not named. InputError where the deck itself has faults.
BestSettings best_settings(const std::string& deck, const std::vector<std::string>& overrides);

// What is gained in the study axis_aligned at its finest resolution, over GIMP with two particles
// along each direction: factors of error and time, below 1 where they are smaller.
struct Gain {
  double error, time;
};
constexpr Gain corner_basis_gain = {1.0 / 66, 0.5};       // CPDI, one particle a direction
constexpr Gain total_lagrangian_gain = {1.0 / 277, 1.0};  // GIMP, two particles, total Lagrangian

}  // namespace sluice
