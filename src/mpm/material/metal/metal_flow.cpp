#include "mpm/material/metal/metal_flow.hpp"

#include "mpm/material/base/metal_parts.hpp"

namespace sluice::mpm {
namespace {

const std::vector<Part>& flows() {
  static const std::vector<Part> list = {{"isotropic_hardening", IsotropicHardening::tags()},
                                         {"johnson_cook", JohnsonCook::tags()},
                                         {"mts_model", MechanicalThreshold::tags()},
                                         {"zerilli_armstrong", ZerilliArmstrong::tags()},
                                         {"steinberg_cochran_guinan", SteinbergGuinan::tags()},
                                         {"preston_tonks_wallace", PrestonTonksWallace::tags()}};
  return list;
}

const std::vector<std::string> not_supported = {"zerilli_armstrong_polymer"};

}  // namespace

TagSpec metal_flow_tag() {
  return submodel_tag("flow_model", "the flow stress", flows(), not_supported).once();
}

std::optional<MetalFlow> read_metal_flow(const Parameters& model) {
  const ChosenSubmodel chosen = choose_submodel(model, "flow_model", flows(), not_supported);
  if (chosen.index < 0) return std::nullopt;
  const Parameters p = inside_submodel(model, "flow_model", flows()[chosen.index]);
  if (!p.good()) return std::nullopt;
  switch (chosen.index) {
    case 0:
      return IsotropicHardening::read(p);
    case 1:
      return JohnsonCook::read(p);
    case 2:
      return MechanicalThreshold::read(p);
    case 3:
      return ZerilliArmstrong::read(p);
    case 4:
      return SteinbergGuinan::read(p);
    default:
      return PrestonTonksWallace::read(p);
  }
}

}  // namespace sluice::mpm
