// Files that a model names.
#pragma once
#include "framework/deck/deck.hpp"

namespace sluice::models {

// Writes the whole path of a file into its node, sought from the working folder and beside the
// deck: a restart from anywhere finds it. Nothing happens without a node, a name or such a file.
void locate_file(DeckNode* node);

}  // namespace sluice::models
