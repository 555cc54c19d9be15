// The levels of a plan as tables for people and as JSON for scripts.
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "app/planned_hierarchy.hpp"

namespace sluice {

std::string levels_text(const PlannedHierarchy& hierarchy);
nlohmann::ordered_json levels_json(const PlannedHierarchy& hierarchy);

}  // namespace sluice
