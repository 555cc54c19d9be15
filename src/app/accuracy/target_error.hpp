// The cheapest resolution of a deck that an error bar promises for a wanted error.
//
// A ladder of coarse runs gives the order p and the error e at its finest resolution; the factor
// that reaches the wanted error E is (e / E)^(1/p). While that is far beyond the ladder, another
// rung is run, as each costs a small share of the run that is chosen.
#pragma once
#include <string>

#include "app/accuracy/deck_ladder.hpp"

namespace sluice {

struct ResolutionChoice {
  double factor = 1;     // of the deck's cells along each direction
  double promised = 0;   // relative error bar at that resolution, of the worst quantity
  std::string quantity;  // that one
  double seconds = 0;    // predicted wall time
  double ladder_seconds = 0;
  std::vector<std::string> overrides;  // what sets the resolution; empty: the deck's own
};

// `quantity`: a label or history, of any material ("rho_CC"); empty: all that is saved. `target`: a
// relative error, above 0. InputError where nothing up to four times the deck's resolution is
// promised to reach it, or nothing of that name is saved.
ResolutionChoice choose_resolution(DeckLadder& ladder, double target, const std::string& quantity);

}  // namespace sluice
