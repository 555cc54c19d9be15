// Rock whose pores are crushed: what the decks of Arenisca, Arenisca3 and Arenisca4 give its law.
#pragma once
#include <memory>

#include "mpm/material/base/material.hpp"
#include "mpm/material/geologic/cap_surface.hpp"
#include "mpm/material/geologic/porous_rock.hpp"

namespace sluice::mpm {

struct AreniscaConstants {
  PorousRock rock;
  LimitCurve limit;
  double G = 0;                         // Pa
  double cap_share = 0;                 // (PEAKI1 - kappa)/(PEAKI1 - X), without unit
  double beta = 1;                      // of plastic flow: 1 associated, less dilates less
  double hardening = 0, kinematic = 0;  // H, c, Pa
  double T1 = 0, T2 = 0;                // s^(1 - T2), 1
  int max_parts = 1;                    // of a step
  double density = 0;                   // kg/m^3
};

std::shared_ptr<const Material> make_arenisca(const AreniscaConstants& constants);

}  // namespace sluice::mpm
