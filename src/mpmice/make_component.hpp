// From a deck to the component of fluid and solids.
#pragma once
#include <memory>

#include "framework/deck/deck.hpp"
#include "mpmice/mpmice.hpp"

namespace sluice::mpmice {

// What is wrong is added to `faults`; with an error among them there is no component.
std::unique_ptr<MpmIce> make_component(const Deck& deck, const Scene& scene,
                                       std::vector<Fault>& faults);

}  // namespace sluice::mpmice
