// What boxes will cost, from what others cost that lay in the same places, and whether that is
// worth other owners.
#pragma once
#include <vector>

#include "framework/grid/level.hpp"

namespace sluice {

// Costs (seconds, say) of the boxes of a level that is laid out anew: each cell costs what the
// cells of the measured box that held it cost on average, a new cell the average of all. Every rank
// must pass the same costs. Empty when nothing was measured.
std::vector<double> carried_costs(const std::vector<GridBox>& measured,
                                  const std::vector<double>& costs,
                                  const std::vector<GridBox>& boxes);

// The boxes dealt out by cost; empty when the busiest rank would not gain a share of `least_gain`
// of its work.
std::vector<GridBox> better_owners(const std::vector<GridBox>& now,
                                   const std::vector<double>& costs, int ranks, double least_gain);

}  // namespace sluice
