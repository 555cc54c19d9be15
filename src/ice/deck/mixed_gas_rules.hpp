// What a gas whose properties follow from a scalar goes without so far.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "framework/deck/deck.hpp"

namespace sluice {

// `model`: that makes a gas a mixture; `names`: of the materials.
void check_mixed_gas(const DeckNode& root, const DeckNode& model,
                     const std::vector<std::string>& names, std::vector<Fault>& faults);

// Which of them is one; nothing where none is.
std::optional<std::size_t> mixed_material(const DeckNode& root,
                                          const std::vector<std::string>& names);

}  // namespace sluice
