// What a scene of peridynamic solids asks for.
#pragma once
#include "framework/task/effect.hpp"
#include "peridynamics/deck/peri_scene.hpp"

namespace sluice::peridynamics {

EffectList effects_of(const PeriScene& scene);

}  // namespace sluice::peridynamics
