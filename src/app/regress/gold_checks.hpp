// A run of a user's deck against the gold beside it: an archive of either format, or .dat files.
#pragma once
#include <filesystem>
#include <vector>

#include "app/regress/regress_case.hpp"

namespace sluice {

// "outputs", "checkpoints", "histories" and "cost"; what the gold does not have is skipped. Gold of
// another format is compared in what both hold: its outputs and histories.
std::vector<RegressCheck> gold_checks(const RegressCase& c, const std::filesystem::path& archive);

// The archive becomes the gold, with what it cost on this machine. InputError where that would
// replace an archive of another program. SystemError when it cannot be copied.
RegressCheck bless_gold(const RegressCase& c, const std::filesystem::path& archive);

}  // namespace sluice
