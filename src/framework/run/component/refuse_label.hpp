// A deck names a variable that its run does not have.
#pragma once
#include <string>
#include <vector>

#include "framework/deck/deck.hpp"

namespace sluice {

enum class LabelUse { save, analyse };  // of anything; of fields alone

// Throws DeckError with the nearest of `names`, those that the run has.
[[noreturn]] void refuse_label(const Location& where, LabelUse use, const std::string& label,
                               const std::vector<std::string>& names);

}  // namespace sluice
