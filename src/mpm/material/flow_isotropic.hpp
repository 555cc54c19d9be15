// isotropic_hardening: sigma_f = sigma_Y + K eps_p.
#pragma once
#include "mpm/material/metal_state.hpp"
#include "mpm/material/parameters.hpp"

namespace sluice::mpm {

struct IsotropicHardening {
  double yield = 0, hardening = 0;

  struct Here {};
  Here at(const MetalState&) const { return {}; }
  double stress(const Here&, double strain, double /*rate*/) const {
    return yield + hardening * strain;
  }

  static Tags tags() {
    return {tag("sigma_Y", "yield stress, Pa").once().real().at_least(0).alias("sigma_0"),
            number("K", "hardening modulus, Pa")};
  }
  static IsotropicHardening read(const Parameters& p) { return {p.real("sigma_Y"), p.real("K")}; }
};

}  // namespace sluice::mpm
