// The parts of read_mpm_scene, one file each.
#pragma once
#include <string>
#include <vector>

#include "framework/deck/deck.hpp"
#include "framework/scene/geometry_reader.hpp"
#include "framework/scene/scene.hpp"
#include "mpm/deck/mpm_scene.hpp"

namespace sluice::mpm {

void read_flags(const DeckNode& root, MpmScene& s, std::vector<Fault>& faults);
// `holds_water`: its pores may.
SolidMaterial read_material(const DeckNode& node, int index, const PhysicalConstants& physical,
                            bool holds_water, const GeometryReader& geometry,
                            std::vector<Fault>& faults);
SeedObject read_seed_object(const DeckNode& node, const GeometryReader& geometry,
                            std::vector<Fault>& faults);
// `block`: <MaterialProperties><MPM>. Materials are there already.
void read_contacts(const DeckNode& block, MpmScene& s, std::vector<Fault>& faults);
// Materials and contacts are there already.
void read_grains(const DeckNode& root, MpmScene& s, std::vector<Fault>& faults);
void read_cohesive_zones(const DeckNode& block, MpmScene& s, std::vector<Fault>& faults);
void read_loads(const DeckNode& root, const GeometryReader& geometry, MpmScene& s,
                std::vector<Fault>& faults);
// Why no step of a deck knows what a particle has lost; empty: it does.
std::string without_losses(const MpmScene& s);
// All else is there already.
void read_lost_energy(const DeckNode& root, MpmScene& s, std::vector<Fault>& faults);
void read_boundaries(const Scene& scene, MpmScene& s, std::vector<Fault>& faults);
// Rows of numbers of a motion: time (s), velocity (m/s) and, where it rotates, origin (m) and
// angular velocity (1/s).
std::vector<std::array<double, 10>> read_profile(const std::string& file, bool rotates);

}  // namespace sluice::mpm
