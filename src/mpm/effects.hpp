// Which effects solids call for, and why.
#pragma once
#include "framework/task/effect.hpp"
#include "mpm/deck/mpm_scene.hpp"

namespace sluice::mpm {

EffectList effects_of(const Scene& scene, const MpmScene& solids);

}  // namespace sluice::mpm
