// What a deck says of water in the pores of solids, the component shmpm: tags, rules, plain data.
#pragma once
#include <vector>

#include "mpm/deck/mpm_scene.hpp"
#include "mpm/deck/schema.hpp"

namespace sluice::mpm {

std::vector<TagSpec> pore_water_flags();  // in <MPM>
std::vector<TagSpec> pore_water_tags();   // in <material>
// Does water move through pores: the component shmpm with <coupled_flow_analysis> true.
bool runs_pore_water(const DeckNode& root);
// Of a <material>; none where it is dry. Its density becomes that of what is there without water,
// (1 - n) rho: only (1 - n) of the space is filled by it.
// `gravity`: m/s^2.
std::optional<PoreWaterConstants> read_pore_water(const DeckNode& material, Vec3 gravity);
// What water in pores cannot be together with is refused by name.
void check_pore_water(const DeckNode& root, std::vector<Fault>& faults);

}  // namespace sluice::mpm
