// The file of <initProfile>: a flame along an axis.
//
// Lines of numbers x T u rho p Y_1 ... Y_N in SI units with x increasing, N mass fractions in the
// order of the mechanism or as a comment line "# x T u rho p Y_A Y_B ..." above names them.
// The closure may be left out where it is the last.
#pragma once
#include <string>
#include <vector>

#include "kinetics/species_gas.hpp"
#include "models/gases/combustion.hpp"

namespace sluice::models {

struct FlameProfile {
  FlameStart state;
  std::vector<StartLine> fractions;  // those carried
};

// InputError with file and line: no such file, a number that is none, too few or too many of
// them, x that does not increase, density, temperature or pressure not above 0, a name that is no
// species.
FlameProfile read_flame(const std::string& file, int axis, const kinetics::SpeciesGas& gas);

}  // namespace sluice::models
