// The mirror image of any deck.
//
// Cells of the image lie exactly where those of the deck lie, mirrored: the deck is first brought
// to a domain centred at 0 with spacings of few digits, so that no position is rounded.
#pragma once
#include <string>

#include "framework/deck/deck.hpp"

namespace sluice::properties {

// Both return XML, without what only looks at a run (analysis modules, exact solution) and with the
// same few saves. They throw std::logic_error at a list of numbers of which they do not know
// whether it is a place, an arrow or neither: a new tag has to be entered in the tables.

// The deck with the middle of its domain at 0. The spacing keeps 36 binary digits, which changes
// lengths by 1e-11 at most. Two things without an image are left out: a start that balances the
// weight, which knows its pressure in one cell, and sources of tracer particles.
std::string centred_deck(const Deck& deck);
// The image of a centred deck in the plane through 0 normal to `axis`.
std::string mirrored_deck(const Deck& centred, int axis);

}  // namespace sluice::properties
