// The components of a switcher as one run: whether each can follow the one before, and what the
// run is told of them.
#pragma once
#include <map>
#include <string>
#include <vector>

#include "app/loading/scene_loader.hpp"
#include "framework/deck/data_file.hpp"
#include "framework/run/component/succession.hpp"

namespace sluice {

// Of parts that are good each for itself.
void check_parts(const LoadedScene& run, std::vector<Fault>& faults);

std::vector<Successor> successors_of(const LoadedScene& run);

// The files that the deck of the run and those of its parts name; the decks then say where an
// archive keeps them.
KeptFiles keep_files_of(LoadedScene& run);

// The decks of the components as XML, for the archive; the deck of the run then names them by the
// names that they have here. Nothing of a deck without parts.
std::map<std::string, std::string> name_subdecks(LoadedScene& run);

}  // namespace sluice
