// The decks of a folder and the gold beside each.
//
//   FOLDER/**/NAME.ups          a deck (or input_as_run.xml, named as its folder)
//             NAME.uda          its gold: an archive of either format, or, where the folder has one
//                               deck, the only archive in it; or .dat files beside the deck
//             NAME.csv          values at the end, with "variables" in NAME.json
//             NAME.json         how it is run and compared (regress_keys.hpp)
//             NAME.cost.json    seconds, memory and the machine, as --bless wrote them
//             *.py              lists of the public suite: ranks, tolerances, no restart
#pragma once
#include <filesystem>
#include <vector>

#include "app/regress/regress_case.hpp"

namespace sluice {

// By name: the path from the folder without its ending. InputError where there is no deck, or a
// file beside one is not as it must be.
std::vector<RegressCase> read_regress_folder(const std::filesystem::path& folder);

}  // namespace sluice
