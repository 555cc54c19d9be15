// The table of <scheme>: what each form of the fluid's step can do. Rules read its columns, never
// its word.
#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "framework/deck/deck.hpp"

namespace sluice::ice {

struct SchemeRow {
  std::string_view word = {};
  bool internal_energy = false;    // the classic form: one stage, internal energy
  bool several_materials = false;  // and any equation of state
  bool conducts_heat = false;
  bool transport_models = false;  // turbulence, viscosities that vary, friction on walls
  bool transports_scalars = false;
  bool implicit = false;        // may solve for the pressure
  bool matches_fluxes = false;  // levels agree on what passes between them, whatever the deck says
};

std::vector<std::string> scheme_words();
// Of <CFD><ICE><scheme>; where it is absent or bad, the default.
const SchemeRow& scheme_of(const DeckNode& root);

}  // namespace sluice::ice
