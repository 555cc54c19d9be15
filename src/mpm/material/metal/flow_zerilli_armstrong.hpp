// zerilli_armstrong (Zerilli and Armstrong 1987), cubic metals of both kinds:
//
//   sigma_f = c_0 + K eps_p^n + B exp(-beta T) + B_0 eps_p^(1/2) exp(-a T)
//   beta = beta_0 - beta_1 ln rate,   a = alpha_0 - alpha_1 ln rate
// c_0, or sigma_g + k_H/l^(1/2) where the deck gives those. c_0, K, B and B_0 in Pa, beta and alpha
// in 1/K, T in K, rates in 1/s, n and strains without unit.
#pragma once
#include <algorithm>
#include <cmath>

#include "mpm/material/base/parameters.hpp"
#include "mpm/material/metal/metal_state.hpp"

namespace sluice::mpm {

struct ZerilliArmstrong {
  double c_0, K, n, B, beta_0, beta_1, B_0, alpha_0, alpha_1;

  struct Here {
    double T;
  };
  Here at(const MetalState& s) const { return {s.temperature}; }
  double stress(const Here& here, double strain, double rate) const {
    const double ln_rate = std::log(std::max(rate, min_rate));
    const double beta = std::max(beta_0 - beta_1 * ln_rate, 0.0);
    const double a = std::max(alpha_0 - alpha_1 * ln_rate, 0.0);
    return c_0 + K * std::pow(strain, n) + B * std::exp(-beta * here.T) +
           B_0 * std::sqrt(strain) * std::exp(-a * here.T);
  }

  static Tags tags() {
    return {tag("c_0", "part without temperature and rate, Pa").real(),
            number("sigma_g",
                   "without <c_0>: part of solutes and the initial density of dislocations, Pa", 0),
            number("k_H", "without <c_0>: coefficient of the grain boundaries, Pa m^(1/2)", 0),
            number("sqrt_l_inv", "without <c_0>: 1/(size of grains)^(1/2), m^(-1/2)", 0),
            number("K", "hardening, Pa", 0),
            number("n", "exponent of hardening", 0),
            number("B", "thermal part of body-centred metals, Pa", 0),
            number("beta_0", "decrease of the thermal part B with temperature, 1/K", 0),
            number("beta_1", "reduction of the decrease beta_0 with ln rate, 1/K", 0),
            number("B_0", "thermal part of face-centred metals, Pa", 0),
            number("alpha_0", "decrease of the thermal part B_0 with temperature, 1/K", 0),
            number("alpha_1", "reduction of the decrease alpha_0 with ln rate, 1/K", 0)};
  }
  static ZerilliArmstrong read(const Parameters& p) {
    const double c_0 =
        p.has("c_0") ? p.real("c_0") : p.real("sigma_g") + p.real("k_H") * p.real("sqrt_l_inv");
    return {c_0,           p.real("K"),       p.real("n"),
            p.real("B"),   p.real("beta_0"),  p.real("beta_1"),
            p.real("B_0"), p.real("alpha_0"), p.real("alpha_1")};
  }
};

}  // namespace sluice::mpm
