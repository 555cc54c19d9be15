// One text of those that ranks have, the same on all.
#pragma once
#include <string>

#include "framework/base/communicator.hpp"

namespace sluice {

// The first in the order of texts of those that are not empty; empty where all are. Collective.
inline std::string lowest_text(Communicator& ranks, const std::string& own) {
  std::string lowest;
  for (const std::string& text : ranks.gather_to_all(own))
    if (!text.empty() && (lowest.empty() || text < lowest)) lowest = text;
  return lowest;
}

}  // namespace sluice
