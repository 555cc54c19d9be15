// The variables that launchers set.
#include "framework/base/launcher.hpp"

#include <algorithm>
#include <cstdlib>

namespace sluice {

bool has_launcher() {
  const auto is_set = [](const char* name) { return std::getenv(name) != nullptr; };
  return std::any_of(rank_counts.begin(), rank_counts.end(), is_set) ||
         std::any_of(rank_numbers.begin(), rank_numbers.end(), is_set);
}

}  // namespace sluice
