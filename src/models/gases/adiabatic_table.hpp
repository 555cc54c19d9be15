// Model "AdiabaticTable": a gas whose properties and heat of mixing stand in a table over its
// mixture fraction.
//
// Columns gamma, heat_capac_Cv, viscosity, thermal_conductivity; Temp, the temperature T_f that the
// mixture has after its streams have mixed at constant pressure without losing heat; reference_Temp
// T_r, reference_gamma and reference_heat_capac_Cv, what it would have without a reaction:
//   Q(f) = T_f cp - T_r cp_r,  cp = gamma cv
// Between two points of the table cv, R = (gamma - 1) cv and Q are linear.
#pragma once
#include <string>
#include <vector>

#include "framework/deck/deck.hpp"
#include "models/gases/mixed_gas.hpp"
#include "models/gases/property_table.hpp"

namespace sluice {
struct TagSpec;
}

namespace sluice::models {

// InputError where the table has no gas.
std::vector<MixedGas::Node> adiabatic_nodes(const PropertyTable& table);

TagSpec adiabatic_table_tag();
void check_adiabatic_table(const DeckNode& parameters, const std::vector<std::string>& materials,
                           std::vector<Fault>& faults);
// A table that cannot be read is a fault, and leaves nodes that nobody may use.
MixedGas read_adiabatic_table(const DeckNode& parameters, const std::vector<std::string>& materials,
                              std::vector<Fault>& faults);

}  // namespace sluice::models
