// What a plan says of the components of a switcher.
#pragma once
#include <string>
#include <vector>

#include "app/plan/run_plan.hpp"

namespace sluice {

class Json;

std::vector<PlannedPart> plan_parts(const LoadedScene& run);
std::string parts_text(const std::vector<PlannedPart>& parts);
Json parts_json(const std::vector<PlannedPart>& parts);

}  // namespace sluice
