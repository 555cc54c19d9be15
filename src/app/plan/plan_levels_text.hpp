// The levels of a plan as tables for people and as JSON for scripts.
#pragma once
#include <string>

#include "app/plan/planned_hierarchy.hpp"

namespace sluice {

class Json;

std::string levels_text(const PlannedHierarchy& hierarchy);
Json levels_json(const PlannedHierarchy& hierarchy);

}  // namespace sluice
