// What boxes will cost, from what others cost that lay in the same places.
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

}  // namespace sluice
