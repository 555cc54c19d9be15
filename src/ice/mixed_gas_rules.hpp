// What a gas whose properties follow from a scalar goes without so far.
#pragma once
#include <string>
#include <vector>

#include "framework/deck/schema.hpp"

namespace sluice {

// `model`: that makes a gas a mixture; `names`: of the materials.
void check_mixed_gas(const DeckNode& root, const DeckNode& model,
                     const std::vector<std::string>& names, std::vector<Fault>& faults);

}  // namespace sluice
