// What a deck says of implicit steps: tags, the rules that hold for them, plain data.
#pragma once
#include <vector>

#include "mpm/deck/mpm_scene.hpp"
#include "mpm/deck/schema.hpp"

namespace sluice::mpm {

std::vector<TagSpec> implicit_tags();  // in <MPM>
// Does the deck ask for implicit steps: component impm, or mpm with <time_integrator>implicit.
bool runs_implicit(const DeckNode& root);
ImplicitSettings read_implicit(const DeckNode& flags);
// What implicit steps cannot do is refused by name.
void check_implicit(const DeckNode& root, std::vector<Fault>& faults);

}  // namespace sluice::mpm
