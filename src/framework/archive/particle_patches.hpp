// Particles by the patches of their level.
#pragma once
#include <vector>

#include "framework/archive/archive.hpp"

namespace sluice {

// The particles of one patch and material.
struct PatchParticles {
  int level = 0;
  int patch = 0;  // its place in Level::boxes
  int material = 0;
  std::vector<std::size_t> places;  // in the lists of this level and material
};

// Patch by patch in the order of levels, materials ascending; patches without particles are left
// out. material < 0: all. Where the archive does not say on which patch a particle is, its place
// decides.
std::vector<PatchParticles> particles_by_patch(const ArchiveStep& step, int material);

}  // namespace sluice
