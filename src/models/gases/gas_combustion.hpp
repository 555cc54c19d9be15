// How a deck says a gas of species (models/gases/combustion.hpp): "gasCombustion" with a mechanism
// of its own, "hydrogenBurke" with the one that is built in.
#pragma once
#include <string>
#include <vector>

#include "framework/deck/deck.hpp"
#include "framework/scene/geometry_reader.hpp"
#include "models/gases/mixed_gas.hpp"
#include "models/scalars/transported_scalar.hpp"

namespace sluice {
struct TagSpec;
}

namespace sluice::models {

TagSpec gas_combustion_tag();
TagSpec hydrogen_burke_tag();
void check_gas_combustion(const DeckNode& parameters, const std::vector<std::string>& materials,
                          std::vector<Fault>& faults);

MixedGas read_gas_combustion(const DeckNode& parameters, const std::vector<std::string>& materials);
// The mass fractions of that gas, in its order.
std::vector<TransportedScalar> read_species(const MixedGas& gas, const DeckNode& parameters,
                                            const GeometryReader& geometry,
                                            std::vector<Fault>& faults);
// Labels of all of them; none where the mechanism cannot be read.
std::vector<std::string> species_labels(const DeckNode& parameters);

}  // namespace sluice::models
