// The decks that stand for their kind in ./dev test.
#include <algorithm>
#include <iterator>
#include <stdexcept>

#include "properties/property_decks.hpp"

namespace sluice::properties {
namespace {

// Of each kind one deck on one level and one on several; together they have one to three
// dimensions, ratios 2 and 4, subcycling and lockstep, every kind of side and of effect.
const char* const kinds[] = {
    "explosion_conducting",  // one gas
    "cube_gravity",
    "amr_explosion_ratio_4",
    "amr_cube_all",
    "cube_gravity_third_order",  // parabolas
    "amr_explosion_ratio_4_third_order",
    "held_region_classic",  // the classic form
    "amr_shock_tube_classic",
    "two_gases_transport",  // several materials of one velocity
    "three_in_a_row_heat",
    "amr_like_gases_all",
    "gas_into_water",  // liquids
    "amr_water_cylinder_three_levels",
    "helium_bubble_drag",  // velocities of their own, drag
    "amr_drops_free_by_four",
    "mixed_gases",  // scalars
    "amr_dyed_water_free",
    "closed_box",  // sources
    "amr_mass_exchange_heat",
    "tracers",  // particles that move with the flow
    "amr_tracers_lockstep",
    "bubble_among_waves",  // open faces
    "amr_vortex_leaving",
    "rarefied_spot",  // slip
    "amr_water_cylinder_slip",
    "explosion_dynamic",  // turbulence
    "amr_water_cylinder_eddies_free",
};

bool is_of_kinds(const PropertyDeck& deck) {
  return std::find(std::begin(kinds), std::end(kinds), deck.name) != std::end(kinds);
}

}  // namespace

std::vector<PropertyDeck> decks_of_kinds() {
  std::vector<PropertyDeck> decks;
  std::copy_if(property_decks().begin(), property_decks().end(), std::back_inserter(decks),
               is_of_kinds);
  if (decks.size() != std::size(kinds)) throw std::logic_error("a kind has no deck");
  return decks;
}

std::vector<PropertyDeck> other_decks() {
  std::vector<PropertyDeck> decks = property_decks();
  std::erase_if(decks, is_of_kinds);
  return decks;
}

}  // namespace sluice::properties
