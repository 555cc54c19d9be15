// Equations of state in one line of text: "StiffenedGas gamma=4.4 pinf=6e8 specific_heat=1816".
//
// Names and parameters are those of a deck's <EOS type="..."> and its material; what is not given
// keeps the law's default.
#pragma once
#include <string>

#include "eos/eos.hpp"

namespace sluice::exact {

// Throws InputError on an unknown law or parameter (the known ones are listed), or no number.
eos::EquationOfState law_from_text(const std::string& text);

// "ideal_gas, StiffenedGas, ...": those that law_from_text() knows.
std::string known_laws();

}  // namespace sluice::exact
