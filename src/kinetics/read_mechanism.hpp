// Mechanisms of gas-phase chemistry in XML, the form with <phase>, <speciesData>, <reactionData>,
// and fits of transport beside each species and in <binaryDiffusionFits>.
#pragma once
#include <string>

#include "kinetics/mechanism.hpp"

namespace sluice::kinetics {

// The species of the first phase in its order, with all reactions, in SI units. InputError with
// file and line: no such file, XML that cannot be read, an element without a known mass, a number
// that is none, a species that has no data, a reaction that is not balanced or of a form other than
// elementary, three-body, falloff (Lindemann, Troe).
Mechanism read_mechanism(const std::string& file);

}  // namespace sluice::kinetics
