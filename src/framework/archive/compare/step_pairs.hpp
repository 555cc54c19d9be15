// Which output of one archive is compared with which of another. Times in s.
#pragma once
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "framework/archive/archive_record.hpp"

namespace sluice {

using StepPair = std::pair<StepEntry, StepEntry>;

// Steps whose times are nearest to each other, at most `tolerance` apart: two programs do not meet
// times exactly. Each step is in one pair at most; `left_over` names those in none.
std::vector<StepPair> pair_nearest_steps(const std::vector<StepEntry>& a,
                                         const std::vector<StepEntry>& b,
                                         std::optional<double> tolerance,
                                         std::vector<std::string>& left_over);

}  // namespace sluice
