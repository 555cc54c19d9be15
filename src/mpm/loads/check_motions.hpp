// Files of motions, read once before a run begins with them.
#pragma once
#include <vector>

#include "framework/deck/deck.hpp"
#include "mpm/deck/mpm_scene.hpp"

namespace sluice::mpm {

// Adds an error where the file of a prescribed deformation or of insertions cannot be read.
void check_motions(const DeckNode& root, const MpmScene& scene, std::vector<Fault>& faults);

}  // namespace sluice::mpm
