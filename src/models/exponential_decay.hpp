// Decay with exp(-(c1 c2 + c3) t), as decks say it of a scalar.
#pragma once
#include "framework/deck/deck.hpp"

namespace sluice {
struct TagSpec;
}

namespace sluice::models {

TagSpec exponential_decay_tag();
// c1 c2 + c3, 1/time; of a scalar without the tag: 0.
double read_decay(const DeckNode& scalar);

}  // namespace sluice::models
