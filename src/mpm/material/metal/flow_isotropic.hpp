// isotropic_hardening: sigma_f = sigma_Y + K eps_p.
#pragma once
#include "mpm/material/base/parameters.hpp"
#include "mpm/material/metal/metal_state.hpp"

namespace sluice::mpm {

struct IsotropicHardening {
  double yield = 0, hardening = 0;  // Pa

  struct Here {};
  Here at(const MetalState&) const { return {}; }
  double stress(const Here&, double strain, double /*rate*/) const {
    return yield + hardening * strain;
  }

  // No alias: <sigma_0> is a tag of another flow model.
  static Tags tags() {
    return {tag("sigma_Y", "yield stress, Pa").real().at_least(0),
            tag("sigma_0", "yield stress under another name, Pa").real().at_least(0),
            number("K", "hardening modulus, Pa")};
  }
  static IsotropicHardening read(const Parameters& p) {
    const char* name = p.has("sigma_Y") ? "sigma_Y" : "sigma_0";
    if (!p.has(name)) {
      p.error(name, "<sigma_Y> is needed: yield stress, Pa");
      return {};
    }
    return {p.real(name), p.real("K")};
  }
};

}  // namespace sluice::mpm
