// What a series of regression cases found, as one HTML page without other files, and as JSON.
#pragma once
#include <string>
#include <vector>

#include "app/regress/regress_case.hpp"

namespace sluice {

class Json;

std::string regress_page(const std::vector<RegressResult>& results);
// {"cases": [{name, good, seconds, checks: {NAME: {verdict, message, moved: [...]}}}]}
Json regress_json(const std::vector<RegressResult>& results);
// The names of all checks, in the order of their first mention.
std::vector<std::string> check_names(const std::vector<RegressResult>& results);

}  // namespace sluice
