// Partially saturated soil: what a deck of ArenaSoil gives its law.
#pragma once
#include <memory>

#include "mpm/material/base/material.hpp"
#include "mpm/material/geologic/cap_surface.hpp"
#include "mpm/material/geologic/wet_soil.hpp"

namespace sluice::mpm {

// How decks describe a limit curve, Pa, 1, Pa, 1.
struct LimitNumbers {
  double PEAKI1 = 0, FSLOPE = 0, STREN = 0, YSLOPE = 0;
};
// c of the first and 1 - c of the second.
LimitNumbers blended(const LimitNumbers& first, const LimitNumbers& second, double c);

struct ArenaConstants {
  WetSoil soil;
  LimitNumbers sound, failed;
  double cap_share = 0;           // CR = (PEAKI1 - kappa)/(PEAKI1 - X), without unit
  double beta = 1;                // of plastic flow, without unit: 1 associated, less dilates less
  double T1 = 0, T2 = 0;          // tau = T1 |D|^-T2: s^(1 - T2), 1; none where one is 0
  bool damage = false;            // coherence falls with the time of plastic flow
  double fspeed = 0, t_fail = 1;  // 1, s
  double part_size = 1;           // change of stress in a part, as a share of the surface's size
  int max_parts = 1;              // of a step
  double density = 0;             // kg/m^3
};

std::shared_ptr<const Material> make_arena(const ArenaConstants& constants);

}  // namespace sluice::mpm
