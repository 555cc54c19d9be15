// How accurate a deck's own run is, without an exact solution: order and error bar of each saved
// field and history, and what the next halving of the cells costs.
#pragma once
#include <string>
#include <vector>

#include "app/accuracy/deck_ladder.hpp"
#include "framework/base/json.hpp"

namespace sluice {

struct DeckAccuracy {
  std::string deck, title;
  std::vector<Rung> rungs;        // coarse to fine
  std::vector<QuantityBar> bars;  // of the finest
  double halved_seconds = 0;  // wall time with twice the cells of the finest along each direction

  // The bar of a rung, relative.
  double bar(const QuantityBar& of, const Rung& rung) const;
};

// Runs what is missing; the deck's own resolution is among the rungs.
DeckAccuracy measure_accuracy(DeckLadder& ladder, const std::string& deck);

std::string accuracy_table(const DeckAccuracy& accuracy);
Json accuracy_json(const DeckAccuracy& accuracy);
// Rows for the picture of error against time: at most six quantities.
Json accuracy_rows(const DeckAccuracy& accuracy);

}  // namespace sluice
