// Decks of the third order: parabolas in cells of one material (parabolas/).
#pragma once
#include <vector>

#include "framework/deck/faults.hpp"

namespace sluice::ice {

// Whether <advection> asks for it.
bool is_third_order(const DeckNode& root);
// What it does not bear is refused by name.
void check_third_order(const DeckNode& root, std::vector<Fault>& faults);

}  // namespace sluice::ice
