// From a <material> of ICE to its thermodynamics: equation of state and specific heat.
#pragma once
#include <optional>
#include <vector>

#include "framework/deck/deck.hpp"
#include "ice/fluid/fluid.hpp"

namespace sluice {
struct TagSpec;
}

namespace sluice::ice {

// threshold: relative difference above which pressures in a deck contradict each other; unit: 1;
//   test: IceSchema.WarnsOfAPressureThatContradicts
constexpr double written_pressure_tolerance = 1e-3;
// threshold: relative change of a density in the last digit that decks write: the pressure change
//   that it causes in a liquid is not a contradiction; unit: 1; test: none
constexpr double last_written_digit = 1e-6;

// Adds one fault for each thing that is wrong: a tag that the law needs and that is not there, a
// number out of its range, a specific heat that cannot stand beside the law. What cannot be read at
// all (no EOS, no number) is told by the schema and passed over; the result is then not usable.
Fluid read_fluid(const DeckNode& material, std::vector<Fault>& faults);

// The fluid of a material that has no fault in these tags.
std::optional<Fluid> readable_fluid(const DeckNode& material);

// <SpecificHeatModel> in a material.
TagSpec specific_heat_tag();

}  // namespace sluice::ice
