// One geometry piece (not a boolean operator) from its tag.
#pragma once
#include "framework/deck/deck.hpp"
#include "framework/geometry/piece.hpp"

namespace sluice {

// InputError says what is wrong with the numbers or the file. Files are looked for in the working
// directory first, then beside the deck.
PiecePtr make_piece(const DeckNode& node);

}  // namespace sluice
