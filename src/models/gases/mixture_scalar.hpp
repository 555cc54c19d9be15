// What models of a mixed gas have in common in a deck: the scalar f that says the mixture.
#pragma once
#include <string>
#include <vector>

#include "framework/deck/deck.hpp"
#include "models/gases/mixed_gas.hpp"
#include "models/scalars/transported_scalar.hpp"

namespace sluice {
struct TagSpec;
}

namespace sluice::models {

// <material> and <scalar>, the latter with `further` elements of the model.
std::vector<TagSpec> mixture_tags(const char* scalar_doc, const std::vector<TagSpec>& further);
// <diffusivity> and <AMR_Refinement_Criteria> of f, which need not be given.
std::vector<TagSpec> diffusion_tags();
// Returns the <scalar>, or null where there is none.
const DeckNode* check_mixture(const DeckNode& parameters, const std::vector<std::string>& materials,
                              std::vector<Fault>& faults);
// Of a gas that gives heat where it mixes: it is the only material so far.
void check_alone(const DeckNode& parameters, const std::vector<std::string>& materials,
                 std::vector<Fault>& faults);

// A gas that knows its names, material and place.
MixedGas read_mixture(const DeckNode& parameters, const std::vector<std::string>& materials);
// The scalars of the gas: f and, where it has a heat of mixing, q. `constants`: the element with
// <diffusivity>.
std::vector<TransportedScalar> read_mixture_scalars(const MixedGas& gas, const DeckNode& scalar,
                                                    const char* constants,
                                                    const GeometryReader& geometry,
                                                    std::vector<Fault>& faults);
// Labels of a model with heat of mixing.
std::vector<std::string> mixing_labels(const DeckNode& parameters);

}  // namespace sluice::models
