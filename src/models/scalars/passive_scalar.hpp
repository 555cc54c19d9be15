// Model "PassiveScalar": an amount carried with a material's mass; it acts on nothing.
//
// Rates: dq/dt = rateOfChange0 + rateOfChange1 q - (c1 c2 + c3) q, and inside each region of
// <interiorSources> dq/dt = rateOfChange (absent: <scalar>, a second), up to <maxScalar>.
#pragma once
#include <string>
#include <vector>

#include "framework/deck/deck.hpp"
#include "models/scalars/transported_scalar.hpp"

namespace sluice {
struct TagSpec;
}

namespace sluice::models {

TagSpec passive_scalar_tag();
void check_passive_scalar(const DeckNode& parameters, const std::vector<std::string>& materials,
                          std::vector<Fault>& faults);
TransportedScalar read_passive_scalar(const DeckNode& parameters,
                                      const std::vector<std::string>& materials,
                                      const GeometryReader& geometry, std::vector<Fault>& faults);

// Of any model with one <scalar>: its start regions, its constants, the labels that it brings.
TagSpec scalar_region_tag();
void check_scalar_region(const DeckNode& object, std::vector<Fault>& faults);
std::vector<ScalarRegion> read_scalar_regions(const DeckNode& parent,
                                              const GeometryReader& geometry,
                                              std::vector<Fault>& faults);
void read_scalar_constants(const DeckNode& scalar, TransportedScalar& s,
                           const char* element = "constants");
std::vector<std::string> scalar_labels(const DeckNode& parameters);

// Old decks save the total of a scalar as sum_scalar-NAME: renamed, with a warning, unless an
// analysis has a variable of that name.
void rename_scalar_totals(DeckNode& root, std::vector<Fault>& faults);

}  // namespace sluice::models
