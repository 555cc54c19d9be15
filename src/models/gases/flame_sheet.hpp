// Model "flameSheet_rxn": fuel and oxidizer that burn at once where they mix (Burke-Schumann).
//
// f is the mass fraction of the fuel stream, f_st where both are used up, dH the heat that a mass
// of fuel gives:
//   Q(f) = dH f for f <= f_st, dH f_st (1 - f)/(1 - f_st) beyond
// Where heat and mass diffuse alike and the pressure is uniform, that is the temperature
//   T(f) = T_ox + (T_fuel - T_ox) f + Q(f)/cp
// S. P. Burke, T. E. W. Schumann, Ind. Eng. Chem. 20 (1928) 998. Heat capacity, viscosity and
// conductivity are those of the material.
#pragma once
#include <string>
#include <vector>

#include "framework/deck/deck.hpp"
#include "models/gases/mixed_gas.hpp"

namespace sluice {
struct TagSpec;
}

namespace sluice::models {

// Q of the law above at its corners, f = 0, f_st, 1; heat_of_combustion: dH, J/kg.
std::vector<MixedGas::Node> flame_sheet_nodes(double f_stoichiometric, double heat_of_combustion);

TagSpec flame_sheet_tag();
void check_flame_sheet(const DeckNode& parameters, const std::vector<std::string>& materials,
                       std::vector<Fault>& faults);
MixedGas read_flame_sheet(const DeckNode& parameters, const std::vector<std::string>& materials);

}  // namespace sluice::models
