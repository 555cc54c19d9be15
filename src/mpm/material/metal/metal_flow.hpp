// <flow_model>: the flow stresses of metals.
#pragma once
#include <optional>
#include <variant>

#include "mpm/material/metal/flow_isotropic.hpp"
#include "mpm/material/metal/flow_johnson_cook.hpp"
#include "mpm/material/metal/flow_mts.hpp"
#include "mpm/material/metal/flow_preston_tonks_wallace.hpp"
#include "mpm/material/metal/flow_steinberg_guinan.hpp"
#include "mpm/material/metal/flow_zerilli_armstrong.hpp"

namespace sluice::mpm {

using MetalFlow = std::variant<IsotropicHardening, JohnsonCook, MechanicalThreshold,
                               ZerilliArmstrong, SteinbergGuinan, PrestonTonksWallace>;

TagSpec metal_flow_tag();
// Without a value after a fault.
std::optional<MetalFlow> read_metal_flow(const Parameters& model);

}  // namespace sluice::mpm
