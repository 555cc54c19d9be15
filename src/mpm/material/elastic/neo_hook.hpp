// The family of the compressible neo-Hookean solid of Simo and Hughes.
//
//   sigma = p I + (G/J) dev(b_bar),   b_bar = J^(-2/3) F F^T
//   p     = K/2 [(J - 1/J) - (J_T - 1/J_T)],   J_T = (1 + alpha_t (T - T_room))^3
//   W     = K/2 [(J^2 - 1)/2 - ln J] + G/2 (tr b_bar - 3)   per reference volume (J_T = 1)
#pragma once
#include <memory>
#include <optional>

#include "mpm/material/base/parameters.hpp"

namespace sluice::mpm {

struct NeoHookConstants {
  double bulk = 0, shear = 0;  // K, G, Pa
  double density = 0;          // kg/m^3
  double expansion = 0;        // alpha_t, 1/K
  double room = 294;           // T where J_T = 1, K
  double J0 = 1;               // volume at the start over that without pressure
};

// Checked: K > 0, G >= 0; initial pressure to J0.
NeoHookConstants neo_hook_constants(const Parameters& parameters);

// The constants of a law that is the elastic solid; nothing for any other law.
std::optional<NeoHookConstants> neo_hookean(const Material& law);

std::shared_ptr<const Material> make_neo_hook(const NeoHookConstants& constants);
// neo_hook_plastic.cpp
std::shared_ptr<const Material> make_neo_hook_plastic(const NeoHookConstants& constants,
                                                      const Parameters& parameters);

}  // namespace sluice::mpm
