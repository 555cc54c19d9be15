// Archives in Uintah's raw layout, for programs that read that: VisIt, and the suite's own tools.
//
// Outputs in one file per level, in the byte order of this machine, without extra cells and without
// compression; histories and decks are copied, checkpoints are not written (no program can continue
// them). Nodes and faces at the high sides of finer levels, which Sluice does not store, have the
// values of the coarser level.
#pragma once
#include <filesystem>
#include <string>

#include "framework/archive/archive.hpp"
#include "framework/archive/selection.hpp"

namespace sluice {

// `time`: one output, as for extract; empty: all. Writes into `folder`, which must not exist, and
// returns it. InputError where no output holds a label that is asked for.
std::filesystem::path export_raw(const Archive& archive, const std::filesystem::path& folder,
                                 const LabelFilter& labels, const std::string& time);

}  // namespace sluice
