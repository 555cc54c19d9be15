// The effects of a run as a table: what is on and why, what it costs.
#pragma once
#include <string>
#include <vector>

#include "framework/run/run_report.hpp"

namespace sluice {

// `measured`: a column with each effect's share of the time measured in tasks.
std::string effect_table(const std::vector<EffectCost>& effects, bool measured);

}  // namespace sluice
