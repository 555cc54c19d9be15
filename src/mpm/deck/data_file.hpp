// Where a deck's data file lies: in the working directory or beside the deck; with a warning, beside
// the deck without the folders that its name gives, and at all three places gzipped (NAME.gz).
#pragma once
#include <string>
#include <vector>

#include "framework/deck/deck.hpp"

namespace sluice::mpm {

// `extension` is added before a file is looked for, and is no part of the answer. Empty: none is
// there, and no fault has been added.
std::string find_data_file(const std::string& name, const std::string& extension,
                           const Location& where, std::vector<Fault>& faults);

// The file that the node names; a fault that lists where it was looked for, and an empty path,
// when there is none.
std::string data_file(const DeckNode& node, std::vector<Fault>& faults);

// Change of a deck: names of pieces whose files lie beside the deck without their folders.
void locate_pieces(DeckNode& root, std::vector<Fault>& faults);

}  // namespace sluice::mpm
