// How far a user's own deck is from failing: its step made longer, its grid coarser, its solids
// stiffer, one at a time.
//
// What must hold: the run comes to its end, at most 1 % of its steps are redone, and the total
// energy grows by at most 1 % of its scale more than in the deck's own run. The factor of the step
// is found by bisection (on a logarithmic scale) between 1 and 4 to within 10 %.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "app/stability/stability_map.hpp"

namespace sluice {

// What one scale was found to bear.
struct DistanceToFailure {
  std::string name;     // "step", "resolution", "moduli of the solids"
  double held = 1;      // the largest factor that held next to the deck's own (least: resolution)
  double failed = 0;    // the nearest that did not; 0: none did
  std::string note;     // why less is known; empty: all was tried
  std::string message;  // of the run that failed
  std::string text() const;  // "factor 1.41 of the step from failing: 1.35 holds, 1.48 does not"
};

struct DeckStability {
  CaseMap map;
  std::vector<DistanceToFailure> distances;
};

// The map with the distances: name, held, failed (null: nothing failed), note, message.
Json deck_stability_json(const DeckStability& found);

// Runs one point; its verdict.
using RunPoint = std::function<StabilityResult(const StabilityCase&, const StabilityPoint&)>;

// `overrides`: PATH=VALUE, of every run. The runs together cost at most `budget` times the deck's
// own as far as costs can be foreseen; what no longer fits is noted. InputError where the deck has
// faults.
DeckStability sweep_deck(const std::string& deck, const std::vector<std::string>& overrides,
                         double budget, const RunPoint& run);

}  // namespace sluice
