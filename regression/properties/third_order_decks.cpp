// The decks that run with parabolas too.
#include <set>

#include "properties/property_decks.hpp"

namespace sluice::properties {

bool bears_parabolas(const std::string& name) {
  static const std::set<std::string> names{"left_blast",
                                           "slow_contact",
                                           "explosion_conducting",
                                           "explosion_dynamic",
                                           "vortex_leaving",
                                           "slip_channel",
                                           "rarefied_spot",
                                           "column",
                                           "water",
                                           "products",
                                           "held_region",
                                           "cube_gravity",
                                           "tracers",
                                           "amr_explosion_ratio_4",
                                           "amr_explosion_greedy",
                                           "amr_dye",
                                           "amr_vortex_leaving",
                                           "amr_cube_all",
                                           "amr_shock_leaving_by_four"};
  return names.contains(name);
}

}  // namespace sluice::properties
