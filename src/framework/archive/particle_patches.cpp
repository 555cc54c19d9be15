// The patches of particles, as stored or by place.
#include "framework/archive/particle_patches.hpp"

#include <algorithm>
#include <map>
#include <tuple>

#include "framework/archive/particle_table.hpp"
#include "framework/archive/selection.hpp"
#include "framework/grid/box_list.hpp"

namespace sluice {
namespace {

// The patch of each particle, as a place on the level.
std::vector<int> patches_of(const ArchiveStep& step, const FieldInfo& position) {
  std::vector<int> patches = step.particle_patches(position);
  if (std::find(patches.begin(), patches.end(), -1) == patches.end()) return patches;
  const Level& level = step.grid().levels.at(position.level);
  std::vector<IndexBox> boxes;
  for (const GridBox& b : level.boxes) boxes.push_back(b.cells);
  const BoxFinder finder(std::move(boxes));
  const auto x = step.read_particles(position);
  for (std::size_t n = 0; n < patches.size(); ++n) {
    const IntVec3 cell = cell_of(level, {x[0][n], x[1][n], x[2][n]});
    const std::vector<int> found = finder.overlapping({cell, cell + IntVec3{1, 1, 1}});
    patches[n] = found.empty() ? 0 : found.front();
  }
  return patches;
}

}  // namespace

std::vector<PatchParticles> particles_by_patch(const ArchiveStep& step, int material) {
  std::map<std::tuple<int, int, int>, PatchParticles> found;
  for (const FieldInfo& f : step.particle_fields()) {
    if (f.name != particle_position_name || (material >= 0 && f.material != material)) continue;
    const std::vector<int> patches = patches_of(step, f);
    for (std::size_t n = 0; n < patches.size(); ++n) {
      PatchParticles& p = found[{f.level, patches[n], f.material}];
      p.level = f.level;
      p.patch = patches[n];
      p.material = f.material;
      p.places.push_back(n);
    }
  }
  std::vector<PatchParticles> list;
  for (auto& [key, p] : found) list.push_back(std::move(p));
  return list;
}

}  // namespace sluice
