// Where the files lie that a deck names: in the working folder or beside the deck, and where the
// deck is reached through a link, beside the deck that the link leads to; with a warning, beside
// the deck without the folders that the name gives, and at all of these places gzipped.
//
// Which tags name files says the schema (`.file()`). What an archive has kept of them lies beside
// the deck that it keeps, and is found there before anywhere else.
#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "framework/deck/deck.hpp"

namespace sluice {

class Schema;

// The folder of the file in which this place is, and that of the file which it is a link to.
std::vector<std::filesystem::path> search_folders(const Location& where);

// `ending` is added before a file is looked for, and is no part of the answer. Empty: none is
// there, and no fault has been added.
std::string find_data_file(const std::string& name, const std::string& ending,
                           const Location& where, std::vector<Fault>& faults);

// The file that the node names; a fault that lists where it was looked for, and an empty path,
// when there is none.
std::string data_file(const DeckNode& node, std::vector<Fault>& faults);

// Change of a deck: names of files become their paths. A file that is not there is left to whoever
// reads it.
void locate_files(DeckNode& root, const Schema& schema, std::vector<Fault>& faults);

// Files to keep, by the names that they get beside the kept deck.
using KeptFiles = std::map<std::string, std::filesystem::path>;

// Adds the files that a deck names, and writes into the deck where they will be kept.
void keep_files(DeckNode& root, const Schema& schema, KeptFiles& files);

}  // namespace sluice
