// What ranks agree on in few words.
#pragma once
#include <string>

#include "framework/base/communicator.hpp"
#include "framework/base/reduction.hpp"

namespace sluice::mpmice {

// Is it so on any rank. Collective.
inline bool on_any(Communicator& ranks, bool here) {
  Reduction all;
  const auto any = all.add_any(here);
  ranks.reduce(all);
  return all.any(any);
}

// The reason of the first rank that has one. Collective.
inline void share_reason(Communicator& ranks, std::string& reason) {
  if (ranks.size() == 1) return;
  for (const std::string& of_rank : ranks.gather_to_all(reason))
    if (!of_rank.empty()) {
      reason = of_rank;
      return;
    }
}

}  // namespace sluice::mpmice
