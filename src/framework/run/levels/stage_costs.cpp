#include "framework/run/levels/stage_costs.hpp"

#include <algorithm>

namespace sluice {

std::size_t StageCosts::place_of(const std::string& name) {
  const auto found =
      std::find_if(costs_.begin(), costs_.end(), [&](const auto& c) { return c.name == name; });
  const auto place = static_cast<std::size_t>(found - costs_.begin());
  if (found == costs_.end()) costs_.push_back({name, 0});
  return place;
}

}  // namespace sluice
