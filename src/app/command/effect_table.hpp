// The effects of a run as a table: what is on and why, what it costs.
#pragma once
#include <string>
#include <vector>

#include "framework/run/component/run_report.hpp"

namespace sluice {

// After a run: each effect's share of the time measured in tasks.
std::string measured_effect_table(const std::vector<EffectCost>& effects);
// Before it: how many fields the tasks of each effect write.
std::string planned_effect_table(const std::vector<EffectCost>& effects,
                                 const std::vector<int>& fields);

// "shock_tube.ups:80", short enough for a table; empty without a place.
std::string short_place(const Location& where);

}  // namespace sluice
