// One <reaction> of the XML of a mechanism.
#pragma once
#include <vector>

#include "kinetics/mechanism.hpp"
#include "kinetics/mechanism_nodes.hpp"

namespace sluice::kinetics {

// What the numbers of the file are in SI.
struct RateUnits {
  double volume = 1;  // length^3/mole, m^3/mol
  double energy = 1;  // of activation, J/mol
};
// From <units>; InputError where a unit is not known.
RateUnits read_rate_units(const DeckNode& units);

// InputError with file and line, see read_mechanism.hpp.
Reaction read_reaction(const DeckNode& node, const SpeciesIndices& places,
                       const std::vector<Species>& species, const RateUnits& units);

}  // namespace sluice::kinetics
