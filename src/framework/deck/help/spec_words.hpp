// Words for the parts of a description.
#pragma once
#include <string>

#include "framework/deck/schema.hpp"

namespace sluice {

std::string need_text(Need need);  // "required", "optional", ...
// "real number greater than 0 and at most 1" or "one of FirstOrder, SecondOrder"; empty: no value.
std::string value_text(const ValueSpec& value);

}  // namespace sluice
