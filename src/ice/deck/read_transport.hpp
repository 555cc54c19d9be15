// <dynamicViscosityModels>, <turbulence> and <wallShearStress>: tags, reading, what must hold.
#pragma once
#include <optional>
#include <vector>

#include "framework/deck/deck.hpp"
#include "framework/scene/scene.hpp"
#include "ice/deck/transport_settings.hpp"

namespace sluice {
struct TagSpec;
}

namespace sluice::ice {

TagSpec viscosity_models_tag();
std::vector<TagSpec> transport_tags();  // below CFD/ICE

ViscosityModels read_viscosity_models(const DeckNode& material);
std::optional<Turbulence> read_turbulence(const DeckNode& ice);
std::vector<WallShear> read_wall_shear(const DeckNode& ice, const Scene& scene,
                                       std::vector<Fault>& faults);

void check_transport(const DeckNode& root, std::vector<Fault>& faults);

}  // namespace sluice::ice
