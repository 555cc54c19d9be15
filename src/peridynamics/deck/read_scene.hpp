// From a checked deck to peridynamic solids as plain data.
#pragma once
#include <vector>

#include "framework/scene/scene.hpp"
#include "peridynamics/deck/peri_scene.hpp"

namespace sluice::peridynamics {

PeriScene read_peri_scene(const Deck& deck, const Scene& scene, std::vector<Fault>& faults);

}  // namespace sluice::peridynamics
